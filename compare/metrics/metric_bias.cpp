// Signed bias: how much lighter and which way tinted the test is on average. Errors of single pixels cancel.
#include <cmath>
#include <limits>

#include "compare/metrics/color_rows.h"
#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"
#include "compare/pooling/pooling.h"

namespace parity::compare {
namespace {

enum Plane { kReferenceLight, kTestLight, kDeltaL, kDeltaA, kDeltaB, kUnusable, kPlanes };

// Added to both mean luminances, so that black has an exposure: some 12 stops below white, half of what the first step
// of an 8-bit sRGB image shows. Both black: 0 EV.
constexpr double kBlack = 1. / 8192;
// What a pixel that is not finite enters as: white for black. A mean of signed errors has no worst side, so these move
// it away from 0, on the side where it is.
constexpr double kWorstEv = 13, kWorstLab = 100;

MetricMaps biasMaps(const MetricInput& input, const MetricOptions& options) {
  const Rect box = boxOf(input, options);
  MetricMaps maps;
  for (int plane = 0; plane < (input.nonFinite.empty() ? kUnusable : kPlanes); ++plane)
    maps.planes.emplace_back(input.width(), input.height(), 1);
  const int n = box.width;
  forRows(box, [&](int y) {
    std::vector<float> rows(9 * static_cast<std::size_t>(n));
    float *rgb = rows.data(), *lab[2] = {rgb + 3 * n, rgb + 6 * n};
    for (int i = 0; i < 2; ++i) {
      const PixelView& view = i == 0 ? input.reference : input.test;
      const base::Image* linear = i == 0 ? input.referenceLinear : input.testLinear;
      readLinearRow(view, nullptr, box.x, y, n, rgb);
      labRow(rgb, n, {lab[i], lab[i] + n, lab[i] + 2 * n});
      if (linear) readLinearRow(view, linear, box.x, y, n, rgb);
      lumaRow(rgb, n, maps.planes[static_cast<std::size_t>(kReferenceLight + i)].at(box.x, y));
    }
    for (int k = 0; k < 3; ++k) {
      float* out = maps.planes[static_cast<std::size_t>(kDeltaL + k)].at(box.x, y);
      for (int i = 0; i < n; ++i) out[i] = lab[1][k * n + i] - lab[0][k * n + i];
    }
  });
  // Such pixels are no part of the means.
  for (base::Image& plane : maps.planes) setPixels(plane, input.nonFinite, 0);
  if (!input.nonFinite.empty()) setPixels(maps.planes[kUnusable], input.nonFinite, 1);
  return maps;
}

// `bias` over the usable share of a region, `worst` over the rest.
double withUnusable(double bias, double worst, double unusable) {
  return unusable > 0 ? (1 - unusable) * bias + unusable * std::copysign(worst, bias) : bias;
}

std::vector<double> pool(const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
  const double unusable = maps.planes.size() > kUnusable ? meanOf(maps.planes[kUnusable], region) : 0;
  const double usable = 1 - unusable;
  const auto mean = [&](Plane plane) { return usable > 0 ? meanOf(maps.planes[plane], region) / usable : 0; };
  std::vector<double> out;
  for (const Statistic& statistic : wanted) {
    const std::string_view part = partOf(statistic);
    if (part == "ev")
      out.push_back(withUnusable(
          std::log2((std::max(mean(kTestLight), 0.) + kBlack) / (std::max(mean(kReferenceLight), 0.) + kBlack)),
          kWorstEv, unusable));
    else
      out.push_back(withUnusable(mean(part == "dl" ? kDeltaL : part == "da" ? kDeltaA : kDeltaB), kWorstLab, unusable));
  }
  return out;
}

} // namespace

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
