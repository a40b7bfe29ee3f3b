// Radiance HDR without the image library, which takes .3 s to load.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "base/image/image_io.h"

namespace parity::base {

// Reads a plain file, as nearly all are: red, green, blue and an exponent, scanlines from the top in runs (Ward 1991,
// "Real Pixels"), variables that change no value. Nothing where the image library has to read it, or to say what is
// wrong. What is returned is what that library would read.
std::optional<ImageFile> readHdr(std::span<const std::byte> bytes, const ImageLimits& limits);

} // namespace parity::base
