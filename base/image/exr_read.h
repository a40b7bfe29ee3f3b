// OpenEXR by its core library in C, without the image library, which takes .3 s to load.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "base/image/image_io.h"

namespace parity::base {

// Reads a file that checkExr() (exr_check.h) has let pass: one part of half and float channels of full size, scanlines
// or one level of tiles, not compressed or by RLE, ZIP or PIZ. Nothing where the image library has to read it, or to
// say what is wrong. What is returned is what that library would read.
std::optional<ImageFile> readExr(std::span<const std::byte> bytes, const ImageLimits& limits);

// How large the picture of such a file is. head: the first bytes of the file, or all; fileBytes: of the whole file.
std::optional<ImageShape> readExrShape(std::span<const std::byte> head, std::size_t fileBytes,
                                       const ImageLimits& limits);

} // namespace parity::base
