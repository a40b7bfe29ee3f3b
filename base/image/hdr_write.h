// Radiance HDR by stb, without the image library, which takes .3 s to load.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

// The bytes of a Radiance HDR file: three channels, 8 bits each beside a common exponent, so a value is short by up to
// 1/128 of the pixel's largest; a pixel below 1e-32 is black. `name` is for messages. Throws Error (exit 4) for a value
// that is negative, not finite or 2^127 and more.
std::vector<std::byte> encodeHdr(const Image& image, const std::string& name);

} // namespace parity::base
