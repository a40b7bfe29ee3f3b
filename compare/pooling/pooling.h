// Many values to few: means, exact order statistics and shares, in double, in one pass without a sort.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/image/image.h"
#include "compare/pooling/region_runs.h"

namespace parity::compare {

// For each p in [0,1] (in `fractions`) the first of `values`, ascending, whose running weight exceeds p times the total
// weight (docs/flip-metric.md 7); the largest weighted value for p = 1. weights: as many as values, finite and >= 0,
// some > 0; empty: all 1. Exact order statistics. Throws Error (failed): no values, no weight, NaN.
std::vector<float> weightedPercentiles(std::span<const float> values, std::span<const float> weights,
                                       std::span<const double> fractions);

// A whole FLIP map pooled as NVIDIA's tool prints it: percentiles weighted by the values themselves. Sums in double.
// The percentiles of an all-zero map are 0.
struct Pooling {
  double mean = 0, weightedMedian = 0, weightedQ1 = 0, weightedQ3 = 0, min = 0, max = 0;
  std::array<std::uint64_t, 100> histogram{}; // pixels in [i/100, (i+1)/100); the last one has 1, too
};
// map: 1 channel, values >= 0. Throws Error (failed) where it is empty, of other than 1 channel, negative, or not
// finite.
Pooling poolMap(const base::Image& map);

// What is wanted of a region's values besides mean, least and largest.
struct DistributionRequest {
  std::vector<double> fractions;  // percentiles, as by weightedPercentiles
  std::vector<double> thresholds; // shares of weight strictly above them (compared as floats)
};
struct Distribution {
  double mean = 0, min = 0, max = 0;
  std::vector<double> percentiles, shares;
};

// Over a region of at least one pixel. plane: 1 channel, no NaN in the region. Weighted by the region's weights. Uses
// all threads; the result does not depend on their number.
Distribution poolPlane(const base::Image& plane, const RegionRuns& region, const DistributionRequest& request = {});

// The weighted mean alone, and the largest value.
double meanOf(const base::Image& plane, const RegionRuns& region);
double largestOf(const base::Image& plane, const RegionRuns& region);

} // namespace parity::compare
