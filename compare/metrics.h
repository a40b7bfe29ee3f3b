// Figures of two displayed images over a set of pixels: pooled FLIP, RMSE, PSNR, luma; and the check for NaN.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"
#include "base/image.h"
#include "compare/figures.h"

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

// For each p in [0,1] (in `fractions`) the first of `values`, ascending, whose running weight exceeds p times the total
// weight (FLIP.md, pooling); the largest weighted value for p = 1. weights: as many as values, finite and >= 0, some
// > 0; empty: all 1. Exact order statistics by radix selection, O(values). Throws Error (failed): no values, no weight,
// NaN.
std::vector<float> weightedPercentiles(std::span<const float> values, std::span<const float> weights,
                                       std::span<const double> fractions);

// A whole FLIP map pooled as NVIDIA's tool prints it: percentiles weighted by the values themselves. Sums in double.
// The percentiles of an all-zero map are 0.
struct Pooling {
  double mean = 0, weightedMedian = 0, weightedQ1 = 0, weightedQ3 = 0, min = 0, max = 0;
};
// map: 1 channel. Throws Error (failed) where it is empty, of other than 1 channel, or not finite.
Pooling poolMap(const base::Image& map);

// Over the whole images, any equal channel counts, range [0,1]. Throw Error: notComparable for unlike images, failed
// for non-finite ones.
double rmse(const base::Image& reference, const base::Image& test);
double psnr(const base::Image& reference, const base::Image& test); // dB; +infinity where identical

// 10 log10(1/mse) dB for a peak of 1; +infinity for 0.
double psnrOfMse(double mse);

// referenceDisplay, testDisplay: display-encoded RGB in [0,1]; flipMap: 1 channel, of the same size. An empty region
// (or one of weight 0) gives pixels = 0 and zeros. Pixels where any of the three is NaN or infinite are counted in
// nonFinite and enter as the largest error there is (FLIP 1, difference 1 in each channel, luma 0), so that no figure
// is NaN and none looks better for them. Throws Error: notComparable for sizes or channels that do not fit; failed for
// a region with a pixel outside the image, out of ascending order, or with a weight that is negative or not finite.
Figures measure(const base::Image& referenceDisplay, const base::Image& testDisplay, const base::Image& flipMap,
                const base::PixelList& region);

} // namespace parity::compare
