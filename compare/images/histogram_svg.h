// The histogram of an error map as a small SVG.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace parity::compare {

struct HistogramPicture {
  std::string title, axis;                           // above it; below its horizontal axis
  std::span<const double> buckets;                   // weights of equal parts of [0,1]
  std::vector<std::pair<std::string, double>> marks; // "mean", 0.12: lines at these values of [0,1]
};

// Self-contained SVG 1.1: bars in magma, the share of pixels on a logarithmic axis of 0.001 % to 100 % (an error map is
// mostly near 0, and what matters is its tail), marks with their values. Names are escaped. Throws Error (failed) where
// there are no buckets, a weight is negative or not finite, or all are 0.
std::string toSvg(const HistogramPicture& picture);

} // namespace parity::compare
