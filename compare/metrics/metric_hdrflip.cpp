// HDR-FLIP as a metric (Andersson et al. 2021), on linear images.
#include <array>

#include <fmt/format.h>

#include "compare/flip/flip_hdr.h"
#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"

namespace parity::compare {
namespace {

MetricMaps hdrFlipMaps(const MetricInput& input, const MetricOptions& options) {
  HdrFlipOptions hdr = options.hdr;
  hdr.ppd = options.ppd;
  hdr.region = options.box;
  HdrFlip found = flipHdr(*input.referenceLinear, *input.testLinear, hdr);
  MetricMaps maps;
  maps.planes.push_back(std::move(found.flip));
  setPixels(maps.planes[0], input.nonFinite, 1);
  maps.planes.push_back(std::move(found.exposure)); // not pooled: for who asks which exposure is worst
  const ExposureRange& range = found.range;
  maps.note = fmt::format("{} exposures from {:.4g} to {:.4g} EV, tone curve {}", range.count, range.start, range.stop,
                          kTonemapperNames[static_cast<std::size_t>(hdr.tonemapper)]);
  if (!range.note.empty()) maps.note += "; " + range.note;
  return maps;
}

std::vector<std::vector<float>> hdrFlipSwapMaps(const MetricInput& reference, std::span<const SwapPixels> swaps,
                                                const MetricOptions& options) {
  HdrFlipOptions hdr = options.hdr;
  hdr.ppd = options.ppd;
  std::vector<FlipSwap> all;
  for (const SwapPixels& swap : swaps)
    all.push_back({swap.pixels, swap.gathered ? PixelView(*swap.gathered->testLinear) : PixelView()});
  std::vector<std::vector<float>> values = flipHdrSwaps(*reference.referenceLinear, all, hdr);
  for (std::size_t s = 0; s < swaps.size(); ++s)
    if (swaps[s].gathered)
      for (const std::uint32_t place : swaps[s].gathered->nonFinite) values[s][place] = 1;
  return values;
}

} // namespace

Metric makeHdrFlipMetric() {
  constexpr std::array<std::string_view, 5> kParts = {"mean", "p50", "p95", "p99", "max"};
  Metric metric;
  metric.name = "hdrflip";
  metric.label = "HDR-FLIP";
  metric.description = "HDR-FLIP (Andersson et al. 2021) of linear images: the largest FLIP over the exposures between "
                       "which the reference is not all dark or all white";
  metric.needsLinear = true;
  metric.statistics = distributionStatistics(metric.name, metric.label, kParts, {});
  metric.hasFractionOver = true;
  metric.makeMaps = hdrFlipMaps;
  metric.makeSwapMaps = hdrFlipSwapMaps;
  metric.pool = poolDistribution;
  return metric;
}

} // namespace parity::compare
