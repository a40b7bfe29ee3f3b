// Root mean square error of displayed values.
#include <cmath>

#include "compare/metrics/error_maps.h"
#include "compare/metrics/mean_rows.h"
#include "compare/metrics/metric_makers.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {

namespace {

void squaredErrorRow(RowSource& row, float* const* out) {
  const float *reference = row.displayed(0), *test = row.displayed(1);
  float* error = out[0];
  for (int i = 0, count = row.count(); i < count; ++i) {
    const float *a = reference + 3 * i, *b = test + 3 * i;
    const float r = b[0] - a[0], g = b[1] - a[1], bl = b[2] - a[2];
    error[i] = (r * r + g * g + bl * bl) * (1.f / 3.f);
  }
}

std::vector<double> rootOf(std::span<const double> means, std::span<const Statistic> wanted) {
  return std::vector<double>(wanted.size(), std::sqrt(means[0]));
}

} // namespace

const MeanRows& squaredErrorRows() {
  static const MeanRows kRows{{1.f}, squaredErrorRow};
  return kRows;
}

MetricMaps squaredErrorMaps(const MetricInput& input, const MetricOptions& options) {
  return {mapsOf(squaredErrorRows(), input, boxOf(input, options)), ""};
}

MeanMetric rmseOfMeans() { return {&squaredErrorRows(), rootOf}; }

Metric makeRmseMetric() {
  Metric metric;
  metric.name = "rmse";
  metric.label = "RMSE";
  metric.description = "root of the mean squared difference of displayed values, over pixels and RGB; 0..1";
  metric.statistics = {{"rmse", "rmse", "RMSE", "", Better::lower, 0, 1, 4}};
  metric.mapsName = "squared error";
  metric.makeMaps = squaredErrorMaps;
  metric.pool = [](const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
    const double mean = meanOf(maps.planes[0], region);
    return rootOf({&mean, 1}, wanted);
  };
  return metric;
}

} // namespace parity::compare
