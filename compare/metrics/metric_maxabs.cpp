// The largest absolute difference of displayed values.
#include <algorithm>
#include <cmath>

#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"
#include "compare/pooling/pooling.h"

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
  metric.hasFractionOver = true;
  metric.pool = [](const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
    // One figure is the largest value, the others are shares of pixels above something.
    std::vector<double> values = poolDistribution(maps, region, wanted);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (wanted[i].name == "maxabs") values[i] = largestOf(maps.planes[0], region);
    return values;
  };
  return metric;
}

} // namespace parity::compare
