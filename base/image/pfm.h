// Portable float maps (PFM), rows bottom-up: the format of the golden FLIP maps.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "base/image/image.h"
#include "base/image/image_io.h"
#include "base/image/image_limits.h"

namespace parity::base {

// Reads 'Pf' (1 channel) or 'PF' (3), either byte order; the scale's size is not applied. Throws Error (exit 4).
Image readPfm(const std::filesystem::path& file, const ImageLimits& limits = {});

// The same from memory; `name` is for messages.
Image decodePfm(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits = {});

// How large it is, by its first bytes. Throws Error (exit 4).
ImageShape readPfmShape(std::span<const std::byte> head, const std::string& name, const ImageLimits& limits = {});

// Writes 1 or 3 channels, little-endian, to a temporary name that is then renamed. Throws Error (exit 4).
void writePfm(const std::filesystem::path& file, const Image& image);

} // namespace parity::base
