// RMSE and PSNR of whole images, and what must hold before anything is compared.
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

// Throws Error (notComparable) where either is empty or the sizes or channel counts differ.
void requireComparable(const base::Image& reference, const base::Image& test);

// Over the whole images, any equal channel counts, range [0,1]. Throw Error: notComparable for unlike images, failed
// for non-finite ones.
double rmse(const base::Image& reference, const base::Image& test);
double psnr(const base::Image& reference, const base::Image& test); // dB; +infinity where identical

// 10 log10(1/mse) dB for a peak of 1; +infinity for 0.
double psnrOfMse(double mse);

} // namespace parity::compare
