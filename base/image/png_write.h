// PNG by hand: a report writes many, and neither libpng nor the image library is fast at it.
#pragma once

#include <cstddef>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

// The bytes of a PNG file of 8 bits a channel. 1 to 4 channels: grey, grey and alpha, RGB, RGBA; alpha is not
// multiplied into the colour. `compression`: as WriteOptions (image_io.h) has it. The same image gives the same bytes.
std::vector<std::byte> encodePng(const Image8& image, int compression);

} // namespace parity::base
