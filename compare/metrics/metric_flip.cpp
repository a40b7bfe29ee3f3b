// LDR-FLIP as a metric (Andersson et al. 2020).
#include <array>

#include "compare/flip/flip.h"
#include "compare/flip/flip_swap.h"
#include "compare/metrics/metric_makers.h"
#include "compare/metrics/metric_parts.h"

namespace parity::compare {
namespace {

MetricMaps ldrFlipMaps(const MetricInput& input, const MetricOptions& options) {
  MetricMaps maps;
  maps.planes.push_back(flipMap(input.reference, input.test, {.ppd = options.ppd, .region = options.box}));
  setPixels(maps.planes[0], input.nonFinite, 1);
  return maps;
}

std::vector<std::vector<float>> ldrFlipSwapMaps(const MetricInput& reference, std::span<const SwapPixels> swaps,
                                                const MetricOptions& options) {
  std::vector<FlipSwap> all;
  for (const SwapPixels& swap : swaps) all.push_back({swap.pixels, swap.gathered ? swap.gathered->test : PixelView()});
  std::vector<std::vector<float>> values = flipSwaps(reference.reference, all, options.ppd);
  for (std::size_t s = 0; s < swaps.size(); ++s)
    if (swaps[s].gathered)
      for (const std::uint32_t place : swaps[s].gathered->nonFinite) values[s][place] = 1;
  return values;
}

} // namespace

Metric makeFlipMetric() {
  constexpr std::array<std::string_view, 5> kParts = {"mean", "p50", "p95", "p99", "max"};
  Metric metric;
  metric.name = "flip";
  metric.label = "FLIP";
  metric.description = "LDR-FLIP (Andersson et al. 2020) of the displayed images: visibility of a difference when one "
                       "image replaces the other; 0: none, 1: largest";
  metric.statistics = distributionStatistics(metric.name, metric.label, kParts, {});
  metric.hasFractionOver = true;
  metric.makeMaps = ldrFlipMaps;
  metric.makeSwapMaps = ldrFlipSwapMaps;
  metric.pool = poolDistribution;
  return metric;
}

} // namespace parity::compare
