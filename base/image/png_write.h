// PNG by libpng itself: a report writes its pictures without the image library, which takes .3 s to load.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

// The bytes of a PNG file of 8 bits a channel. 1 to 4 channels: grey, grey and alpha, RGB, RGBA; alpha is not
// multiplied into the colour. `compression` is zlib's level, 1 to 9. The same image gives the same bytes. `name` is for
// messages. Throws Error (exit 4).
std::vector<std::byte> encodePng(const Image8& image, int compression, const std::string& name);

} // namespace parity::base
