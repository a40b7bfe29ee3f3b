#include "report/wording.h"

#include <algorithm>

#include <fmt/format.h>

#include "compare/verdict/wording.h"
#include "report/term_words.h"

namespace parity::report {
namespace {

constexpr double kLeastExplained = 0.1; // of FLIP

} // namespace

std::string describeGone(const GoneRow& row) {
  const std::string what = !row.material.empty()
                               ? fmt::format("material '{}', scene {}, view {}", row.material, row.scene, row.view)
                           : !row.view.empty() ? fmt::format("view {} of scene {}", row.view, row.scene)
                                               : "scene " + row.scene;
  return fmt::format("gone: {}: in the baseline, but not in this run", what);
}

std::string titleOf(const std::string& path) { return path == "highend" ? "high-end" : path; }

std::string describeCause(const compare::Attribution& attribution, const std::string& reference) {
  const std::string flip = compare::formatFigure("flip.mean", attribution.flip);
  if (flip == compare::formatFigure("flip.mean", 0)) return {};
  const auto best = std::ranges::min_element(attribution.terms, {}, &compare::TermEffect::flip);
  if (best == attribution.terms.end() || !(best->flip <= (1 - kLeastExplained) * attribution.flip))
    return "no single term explains it";
  return fmt::format("{}: FLIP {} -> {} with the {} term", termWithWords(best->term), flip,
                     compare::formatFigure("flip.mean", best->flip), titleOf(reference));
}

} // namespace parity::report
