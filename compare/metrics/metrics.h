// What is not finite in an image, and PSNR.
#pragma once

#include <cstdint>

#include "base/image/image.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {

// Pixels with a NaN or infinite channel, and the first of them in row order (-1, -1 where there is none).
struct NonFinite {
  std::uint64_t count = 0;
  int x = -1, y = -1;
};
NonFinite countNonFinite(const base::Image& image);

// Throws Error (failed) "<name>: x 3, y 7: 12 pixels are NaN or infinite" where there are any.
void requireFinite(const base::Image& image, const char* name);

// 10 log10(1/mse) dB for a peak of 1; +infinity for 0.
double psnrOfMse(double mse);

} // namespace parity::compare
