// What the files of the metrics share: boxes, maps made of pairs of rows, figures of a distribution.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "compare/metrics/metric.h"

namespace parity::compare {

// The part of the images that maps are needed of. Throws Error (failed) for a box that is empty or reaches beyond them.
Rect boxOf(const MetricInput& input, const MetricOptions& options);

// Rec.709 luma of a displayed image within the box; 0 outside.
base::Image lumaMap(const PixelView& view, const Rect& box);

// "p95" of "flip.p95"; empty for a figure that is named like its metric.
std::string_view partOf(const Statistic& statistic);

// The range and unit that a metric's figures of a distribution share.
struct DistributionRange {
  Better better = Better::lower;
  double least = 0, most = 1;
  int digits = 3;
};
// metric.mean, .p05, .p50, .p95, .p99, .min, .max: those of `parts`, in that order.
std::vector<Statistic> distributionStatistics(const std::string& metric, const std::string& label,
                                              std::span<const std::string_view> parts, const DistributionRange& range);

// Pools the first plane: mean, pNN, min, max, fraction_over(X).
std::vector<double> poolDistribution(const MetricMaps& maps, const RegionRuns& region,
                                     std::span<const Statistic> wanted);

// Rows of both images, 3*count values each.
struct RowPair {
  const float *reference, *test;
};
// A map each of whose rows is made from the displayed (or linear) rows of the pair; `worst` where input.nonFinite says.
using RowFunction = std::function<void(const RowPair& rows, int count, float* out)>;
base::Image mapOfDisplayed(const MetricInput& input, const MetricOptions& options, float worst,
                           const RowFunction& make);
base::Image mapOfLinear(const MetricInput& input, const MetricOptions& options, float worst, const RowFunction& make);

} // namespace parity::compare
