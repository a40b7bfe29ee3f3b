// Relative mean squared error of linear light.
#include <limits>

#include "compare/metric_makers.h"
#include "compare/metric_parts.h"
#include "compare/pooling.h"

namespace parity::compare {
namespace {

// (t-r)^2 / (r^2 + 0.01), the mean of R, G, B (Rousselle, Knaus, Zwicker 2011, section 5: the 0.01 keeps dark pixels
// from deciding alone).
constexpr float kEpsilon = 0.01f;

// A white pixel where black was due: the largest error that a displayed image can have.
constexpr float kWorst = 1.f / kEpsilon;

void relativeErrorRow(const RowPair& rows, int count, float* out) {
  for (int i = 0; i < count; ++i) {
    float sum = 0;
    for (int c = 0; c < 3; ++c) {
      const float r = rows.reference[3 * i + c], d = rows.test[3 * i + c] - r;
      sum += d * d / (r * r + kEpsilon);
    }
    out[i] = sum * (1.f / 3.f);
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
