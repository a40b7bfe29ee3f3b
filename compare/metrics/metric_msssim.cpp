// MS-SSIM as a metric (Wang, Simoncelli, Bovik 2003, "Multi-scale structural similarity for image quality assessment"),
// on the luma of displayed images.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "compare/metrics/color_rows.h"
#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"
#include "compare/metrics/ssim_maps.h"
#include "compare/pooling/pooling.h"
#include "compare/pooling/scaled_weights.h"

namespace parity::compare {
namespace {

// Section 4: the exponents of the five scales, from the finest.
constexpr std::array<double, 5> kExponents = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
constexpr int kWindow = 11;

// Five, or fewer where the coarsest would be smaller than a window.
std::size_t scalesOf(int width, int height) {
  std::size_t scales = 1;
  for (int side = std::min(width, height) / 2; scales < kExponents.size() && side >= kWindow; side /= 2) ++scales;
  return scales;
}

// Means of 2x2 pixels; at an odd edge of those there are.
base::Image halve(const base::Image& in) {
  base::Image out((in.width + 1) / 2, (in.height + 1) / 2, 1);
  forRows({0, 0, out.width, out.height}, [&](int y) {
    const float *top = in.at(0, 2 * y), *bottom = in.at(0, std::min(2 * y + 1, in.height - 1));
    float* row = out.at(0, y);
    for (int x = 0; x < in.width / 2; ++x)
      row[x] = 0.25f * ((top[2 * x] + top[2 * x + 1]) + (bottom[2 * x] + bottom[2 * x + 1]));
    if (in.width % 2 != 0) row[out.width - 1] = 0.5f * (top[in.width - 1] + bottom[in.width - 1]);
  });
  return out;
}

Rect halve(const Rect& box) {
  const int x = box.x / 2, y = box.y / 2;
  return {x, y, (box.x + box.width + 1) / 2 - x, (box.y + box.height + 1) / 2 - y};
}

// Planes: the contrast and structure of each scale, but all of SSIM at the coarsest (equation 7).
MetricMaps msSsimMaps(const MetricInput& input, const MetricOptions& options) {
  Rect box = boxOf(input, options);
  const Rect everything{0, 0, input.width(), input.height()};
  const std::size_t scales = scalesOf(input.width(), input.height());
  base::Image reference = lumaMap(input.reference, everything), test = lumaMap(input.test, everything);
  MetricMaps maps;
  for (std::size_t scale = 0; scale < scales; ++scale) {
    if (scale > 0) {
      reference = halve(reference);
      test = halve(test);
      box = halve(box);
    }
    SsimMaps ssim = ssimMaps(reference, test, box);
    base::Image& plane = maps.planes.emplace_back(std::move(scale + 1 < scales ? ssim.structure : ssim.ssim));
    for (const std::uint32_t pixel : input.nonFinite) {
      const auto width = static_cast<std::uint32_t>(input.width());
      *plane.at(static_cast<int>(pixel % width >> scale), static_cast<int>(pixel / width >> scale)) = -1;
    }
  }
  return maps;
}

// Product of the scales' means over the region, each raised to its exponent; of fewer scales than five the exponents
// are scaled to the same sum. A negative mean counts as 0: its power is no number.
double poolScales(const MetricMaps& maps, const RegionRuns& region) {
  const std::size_t scales = maps.planes.size();
  const double all = std::accumulate(kExponents.begin(), kExponents.end(), 0.),
               used = std::accumulate(kExponents.begin(), kExponents.begin() + static_cast<long>(scales), 0.);
  ScaledWeights weights(region, maps.planes[0].width, maps.planes[0].height, static_cast<int>(scales) - 1);
  double product = 1;
  for (std::size_t scale = 0; scale < scales; ++scale) {
    if (scale > 0) weights.halve();
    const double mean = scale == 0 ? meanOf(maps.planes[0], region) : weights.meanOf(maps.planes[scale]);
    product *= std::pow(std::max(mean, 0.), kExponents[scale] * all / used);
  }
  return product;
}

} // namespace

Metric makeMsSsimMetric() {
  Metric metric;
  metric.name = "msssim";
  metric.label = "MS-SSIM";
  metric.description = "multi-scale structural similarity (Wang et al. 2003, five scales; fewer, with the weights "
                       "rescaled, where the shorter side is below 176) of the displayed images' luma; 1: identical";
  metric.statistics = {{"msssim", "msssim", "MS-SSIM", "", Better::higher, 0, 1, 4}};
  metric.reach = kReachesAll;
  metric.makeMaps = msSsimMaps;
  metric.pool = [](const MetricMaps& maps, const RegionRuns& region, std::span<const Statistic> wanted) {
    return std::vector<double>(wanted.size(), poolScales(maps, region));
  };
  return metric;
}

} // namespace parity::compare
