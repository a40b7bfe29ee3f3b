// How large a JPEG is, before the library sees it: opening a progressive one takes the memory of all its coefficients.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "base/image/image_io.h"
#include "base/image/image_limits.h"

namespace parity::base {

// By the frame header (ITU-T T.81, B.2.2). Throws Error (exit 4) where there is none, for a size beyond the limits, and
// where the coefficients, 16 bit each, are more than their maxBytes.
ImageShape readJpegShape(std::span<const std::byte> bytes, const std::string& name, const ImageLimits& limits);

} // namespace parity::base
