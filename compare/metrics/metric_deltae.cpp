// CIEDE2000 as a metric: the colour difference of pixels side by side, in steps of which about one is just visible.
#include <array>
#include <limits>

#include "compare/metrics/ciede2000.h"
#include "compare/metrics/color_rows.h"
#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"

namespace parity::compare {
namespace {

// Above what any two colours of sRGB have (119, near blue against green).
constexpr float kWorst = 120;

MetricMaps deltaEMaps(const MetricInput& input, const MetricOptions& options) {
  const Rect box = boxOf(input, options);
  MetricMaps maps;
  base::Image& map = maps.planes.emplace_back(input.width(), input.height(), 1);
  const int n = box.width;
  forRows(box, [&](int y) {
    std::vector<float> rows(9 * static_cast<std::size_t>(n));
    float* rgb = rows.data();
    LabRow lab[2];
    for (int i = 0; i < 2; ++i) {
      float* planes = rgb + 3 * n * (i + 1);
      lab[i] = {planes, planes + n, planes + 2 * n};
      readLinearRow(i == 0 ? input.reference : input.test, nullptr, box.x, y, n, rgb);
      labRow(rgb, n, lab[i]);
    }
    ciede2000Row(lab[0], lab[1], n, map.at(box.x, y));
  });
  setPixels(map, input.nonFinite, kWorst);
  return maps;
}

} // namespace

Metric makeDeltaEMetric() {
  constexpr std::array<std::string_view, 3> kParts = {"mean", "p95", "max"};
  Metric metric;
  metric.name = "deltae";
  metric.label = "CIEDE2000";
  metric.description = "CIEDE2000 (Sharma et al. 2005) of the displayed images, D65: about 1 is just visible side by "
                       "side, 100 is black against white";
  metric.statistics = distributionStatistics(metric.name, metric.label, kParts,
                                             {Better::lower, 0, std::numeric_limits<double>::infinity(), 2});
  metric.hasFractionOver = true;
  metric.makeMaps = deltaEMaps;
  metric.pool = poolDistribution;
  return metric;
}

} // namespace parity::compare
