// Whether a PNG file is whole, before a decoder sees it.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/image/image_io.h"

namespace parity::base {

// Follows the chunks of a PNG file (ISO/IEC 15948, section 5) to its end. Throws Error (exit 4), naming the chunk,
// where one is cut off or does not match its checksum; libpng would complain on stderr in its own words. Returns at
// once where the bytes are no PNG file. Of the limits those of the size are meant.
void checkPng(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits = {});

// By the IHDR chunk of the first bytes of a PNG file. Throws Error (exit 4) where there is none, or beyond the limits.
ImageShape readPngShape(std::span<const std::byte> head, const std::string& name, const ImageLimits& limits);

} // namespace parity::base
