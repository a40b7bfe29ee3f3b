#include "compare/metrics/attribution.h"

namespace parity::compare {

std::vector<Attribution> attributeTerms(const SwapReference& reference, std::span<const AttributionInput> materials) {
  std::vector<Swap> swaps;
  for (const AttributionInput& material : materials) {
    swaps.push_back(material.swap);
    for (const TermSwap& term : material.terms) swaps.push_back(term.swap);
  }
  const std::vector<Figures> figures = measureSwaps(reference, swaps, {.statistics = {"flip.mean"}}).figures;
  std::vector<Attribution> results;
  auto next = figures.begin();
  const auto flip = [&] { return (next++)->find("flip.mean").value_or(0); };
  for (const AttributionInput& material : materials) {
    Attribution& result = results.emplace_back();
    result.flip = flip();
    for (const TermSwap& term : material.terms) result.terms.push_back({term.term, flip()});
  }
  return results;
}

} // namespace parity::compare
