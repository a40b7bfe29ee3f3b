// SSIM as a metric (Wang et al. 2004), on the luma of displayed images.
#include <array>

#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"
#include "compare/metrics/ssim_maps.h"

namespace parity::compare {

Metric makeSsimMetric() {
  constexpr std::array<std::string_view, 3> kParts = {"mean", "p05", "min"};
  Metric metric;
  metric.name = "ssim";
  metric.label = "SSIM";
  metric.description = "structural similarity (Wang et al. 2004: Gaussian window 11x11, sigma 1.5, K 0.01 and 0.03, "
                       "edges mirrored) of the displayed images' luma; 1: identical, -1: smallest";
  metric.statistics = distributionStatistics(metric.name, metric.label, kParts, {Better::higher, -1, 1, 4});
  metric.reach = 5; // half of the window
  metric.makeMaps = [](const MetricInput& input, const MetricOptions& options) {
    const Rect box = boxOf(input, options), everything{0, 0, input.width(), input.height()};
    MetricMaps maps;
    maps.planes.push_back(ssimMaps(lumaMap(input.reference, everything), lumaMap(input.test, everything), box).ssim);
    setPixels(maps.planes[0], input.nonFinite, -1);
    return maps;
  };
  metric.pool = poolDistribution;
  return metric;
}

} // namespace parity::compare
