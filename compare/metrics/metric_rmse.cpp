// Root mean square error of displayed values.
#include <cmath>

#include "compare/metrics/error_maps.h"
#include "compare/metrics/metric_makers.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {

MetricMaps squaredErrorMaps(const MetricInput& input, const MetricOptions& options) {
  MetricMaps maps;
  maps.planes.push_back(mapOfDisplayed(input, options, 1, [](const RowPair& rows, int count, float* out) {
    for (int i = 0; i < count; ++i) {
      const float *a = rows.reference + 3 * i, *b = rows.test + 3 * i;
      const float r = b[0] - a[0], g = b[1] - a[1], bl = b[2] - a[2];
      out[i] = (r * r + g * g + bl * bl) * (1.f / 3.f);
    }
  }));
  return maps;
}

Metric makeRmseMetric() {
  Metric metric;
  metric.name = "rmse";
  metric.label = "RMSE";
  metric.description = "root of the mean squared difference of displayed values, over pixels and RGB; 0..1";
  metric.statistics = {{"rmse", "rmse", "RMSE", "", Better::lower, 0, 1, 4}};
  metric.mapsName = "squared error";
  metric.makeMaps = squaredErrorMaps;
  metric.pool = [](const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
    return std::vector<double>(wanted.size(), std::sqrt(meanOf(maps.planes[0], region)));
  };
  return metric;
}

} // namespace parity::compare
