// Peak signal-to-noise ratio of displayed values.
#include <limits>

#include "compare/metrics/error_maps.h"
#include "compare/metrics/mean_rows.h"
#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metrics.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {

MeanMetric psnrOfMeans() {
  return {&squaredErrorRows(), [](std::span<const double> means, std::span<const Statistic> wanted) {
            return std::vector<double>(wanted.size(), psnrOfMse(means[0]));
          }};
}

Metric makePsnrMetric() {
  Metric metric;
  metric.name = "psnr";
  metric.label = "PSNR";
  metric.description =
      "10 log10(1 / mean squared difference of displayed values), dB; infinite where they are identical";
  metric.statistics = {{"psnr", "psnr", "PSNR", "dB", Better::higher, 0, std::numeric_limits<double>::infinity(), 1}};
  metric.mapsName = "squared error";
  metric.makeMaps = squaredErrorMaps;
  metric.pool = [](const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
    return std::vector<double>(wanted.size(), psnrOfMse(meanOf(maps.planes[0], region)));
  };
  return metric;
}

} // namespace parity::compare
