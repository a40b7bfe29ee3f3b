// Signed bias: how much lighter and which way tinted the test is on average. Errors of single pixels cancel.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/color_rows.h"
#include "compare/metrics/mean_rows.h"
#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {
namespace {

enum Plane { kReferenceLight, kTestLight, kDeltaL, kDeltaA, kDeltaB, kUnusable, kPlanes };

// Added to both mean luminances, so that black has an exposure: some 12 stops below white, half of what the first step
// of an 8-bit sRGB image shows. Both black: 0 EV.
constexpr double kLuminanceFloor = 1. / 8192;
// What a pixel that is not finite enters as: white for black. A mean of signed errors has no worst side, so these move
// it away from 0, on the side where it is.
constexpr double kWorstEv = 13, kWorstLab = 100;

void biasRow(RowSource& row, float* const* out) {
  const int n = row.count();
  float* lab[2] = {row.room(0), row.room(1)};
  for (int i = 0; i < 2; ++i) {
    labRow(row.decoded(i), n, {lab[i], lab[i] + n, lab[i] + 2 * n});
    lumaRow(row.light(i), n, out[kReferenceLight + i]);
  }
  for (int k = 0; k < 3; ++k) {
    const float *reference = lab[0] + k * n, *test = lab[1] + k * n;
    float* difference = out[kDeltaL + k];
    for (int i = 0; i < n; ++i) difference[i] = test[i] - reference[i];
  }
  std::fill_n(out[kUnusable], n, 0.f);
}

// Pixels that are not finite are no part of the means.
const MeanRows& biasRows() {
  static const MeanRows kRows{{0, 0, 0, 0, 0, 1}, biasRow};
  return kRows;
}

MetricMaps biasMaps(const MetricInput& input, const MetricOptions& options) {
  return {mapsOf(biasRows(), input, boxOf(input, options)), ""};
}

// `bias` over the usable share of a region, `worst` over the rest.
double withUnusable(double bias, double worst, double unusable) {
  return unusable > 0 ? (1 - unusable) * bias + unusable * std::copysign(worst, bias) : bias;
}

std::vector<double> poolMeans(std::span<const double> means, std::span<const Statistic> wanted) {
  const double unusable = means[kUnusable], usable = 1 - unusable;
  const auto mean = [&](Plane plane) { return usable > 0 ? means[plane] / usable : 0; };
  std::vector<double> out;
  for (const Statistic& statistic : wanted) {
    const std::string_view part = partOf(statistic);
    if (part == "ev")
      out.push_back(withUnusable(std::log2((std::max(mean(kTestLight), 0.) + kLuminanceFloor) /
                                           (std::max(mean(kReferenceLight), 0.) + kLuminanceFloor)),
                                 kWorstEv, unusable));
    else
      out.push_back(withUnusable(mean(part == "dl" ? kDeltaL : part == "da" ? kDeltaA : kDeltaB), kWorstLab, unusable));
  }
  return out;
}

std::vector<double> pool(const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
  std::vector<double> means;
  for (const base::Image& map : maps.planes) means.push_back(meanOf(map, region));
  return poolMeans(means, wanted);
}

} // namespace

MeanMetric biasOfMeans() { return {&biasRows(), poolMeans}; }

Metric makeBiasMetric() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Metric metric;
  metric.name = "bias";
  metric.label = "bias";
  metric.description = "test minus reference: log2 of the ratio of mean linear luminances (each + 1/8192), and mean "
                       "differences of CIELAB of the displayed images";
  metric.statistics = {
      {"bias.ev", "bias", "mean exposure difference", "EV", Better::nearZero, 0, kInfinity, 2},
      {"bias.dl", "bias", "mean lightness difference (dL*)", "", Better::nearZero, 0, 100, 2},
      {"bias.da", "bias", "mean red-green difference (da*)", "", Better::nearZero, 0, kInfinity, 2},
      {"bias.db", "bias", "mean yellow-blue difference (db*)", "", Better::nearZero, 0, kInfinity, 2},
  };
  metric.makeMaps = biasMaps;
  metric.pool = pool;
  return metric;
}

} // namespace parity::compare
