// The largest absolute difference of displayed values.
#include <algorithm>
#include <cmath>

#include "compare/metric_makers.h"
#include "compare/metric_parts.h"
#include "compare/pooling.h"

namespace parity::compare {
namespace {

void largestDifferenceRow(const RowPair& rows, int count, float* out) {
  for (int i = 0; i < count; ++i) {
    const float *a = rows.reference + 3 * i, *b = rows.test + 3 * i;
    out[i] = std::max({std::fabs(b[0] - a[0]), std::fabs(b[1] - a[1]), std::fabs(b[2] - a[2])});
  }
}

} // namespace

Metric makeMaxAbsMetric() {
  Metric metric;
  metric.name = "maxabs";
  metric.label = "largest difference";
  metric.description = "largest absolute difference of a displayed value, over pixels and RGB; 0..1";
  metric.statistics = {{"maxabs", "maxabs", "largest difference of a channel", "", Better::lower, 0, 1, 3}};
  metric.makeMaps = [](const MetricInput& input, const MetricOptions& options) {
    MetricMaps maps;
    maps.planes.push_back(mapOfDisplayed(input, options, 1, largestDifferenceRow));
    return maps;
  };
  metric.pool = [](const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
    return std::vector<double>(wanted.size(), largestOf(maps.planes[0], region));
  };
  return metric;
}

} // namespace parity::compare
