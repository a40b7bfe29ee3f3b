// Relative mean squared error of linear light.
#include <algorithm>
#include <limits>

#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {
namespace {

// (t-r)^2 / (r^2 + 0.01), the mean of R, G, B (Rousselle, Knaus, Zwicker 2011, section 5: the 0.01 keeps dark pixels
// from deciding alone).
constexpr double kEpsilon = 0.01;

// A white pixel where black was due: the largest error that a displayed image can have. (Light beyond white can have
// more; pixels that are not finite fail whatever they add here.)
constexpr float kWorst = 100;

constexpr double kMost = static_cast<double>(std::numeric_limits<float>::max());

void relativeErrorRow(const RowPair& rows, int count, float* out) {
  for (int i = 0; i < count; ++i) {
    double sum = 0; // squares of large floats are none
    for (int c = 0; c < 3; ++c) {
      const double r = static_cast<double>(rows.reference[3 * i + c]);
      const double d = static_cast<double>(rows.test[3 * i + c]) - r;
      sum += d * d / (r * r + kEpsilon);
    }
    out[i] = static_cast<float>(std::min(sum * (1. / 3.), kMost));
  }
}

} // namespace

Metric makeRelMseMetric() {
  Metric metric;
  metric.name = "relmse";
  metric.label = "relMSE";
  metric.description =
      "mean of (t-r)^2 / (r^2 + 0.01) over pixels and linear RGB (Rousselle et al. 2011); of displayed "
      "images without linear ones: decoded";
  metric.statistics = {
      {"relmse", "relmse", "relMSE", "", Better::lower, 0, std::numeric_limits<double>::infinity(), 4}};
  metric.makeMaps = [](const MetricInput& input, const MetricOptions& options) {
    MetricMaps maps;
    maps.planes.push_back(mapOfLinear(input, options, kWorst, relativeErrorRow));
    return maps;
  };
  metric.pool = [](const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
    return std::vector<double>(wanted.size(), meanOf(maps.planes[0], region));
  };
  return metric;
}

} // namespace parity::compare
