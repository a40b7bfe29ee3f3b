// Figures that are means: the rows of their maps are added up where they are made, and no map is kept.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "compare/metrics/metric.h"
#include "compare/metrics/row_source.h"

namespace parity::compare {

// Maps of a pair, row by row.
struct MeanRows {
  std::vector<float> worst; // of each map: its value at input.nonFinite
  // Fills out[k], row.count() values, for each map k.
  void (*make)(RowSource& row, float* const* out);
};

// A metric that needs the means of such maps alone.
struct MeanMetric {
  const MeanRows* rows = nullptr;
  std::vector<double> (*pool)(std::span<const double> means, std::span<const Statistic> wanted) = nullptr;
};

// Without `rows` for a metric that is none.
MeanMetric findMeanMetric(std::string_view name);

const MeanRows& squaredErrorRows(); // of rmse and psnr
MeanMetric rmseOfMeans(), psnrOfMeans(), biasOfMeans();

// The maps as pictures. 0 outside the box.
std::vector<base::Image> mapsOf(const MeanRows& rows, const MetricInput& input, const Rect& box);

// The means over each region of the maps of all `rows`, one after another, in one pass; as meanOf() (compare/pooling)
// has them, to the bit. Nothing for a region without pixels.
std::vector<std::vector<double>> meansOf(std::span<const MeanRows* const> rows, const MetricInput& input,
                                         std::span<const RegionRuns> regions);

} // namespace parity::compare
