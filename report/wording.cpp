#include "report/wording.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/interrupt.h"
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

std::string describeNotRun(const Report& report) {
  std::vector<std::string> names;
  std::string why;
  for (const SceneResult& scene : report.scenes)
    if (isNotRun(scene)) {
      names.push_back(scene.name);
      why = base::signalName(stoppedBy(scene)) + " interrupted the run";
    }
  if (names.empty()) return {};
  return fmt::format("not run: {} of {} scene{} ({}): {}", names.size(), report.scenes.size(),
                     report.scenes.size() == 1 ? "" : "s", why, fmt::join(names, ", "));
}

std::string titleOf(const std::string& path) { return path == "highend" ? "high-end" : path; }

std::optional<compare::TermEffect> findCause(const compare::Attribution& attribution) {
  const auto best = std::ranges::min_element(attribution.terms, {}, &compare::TermEffect::flip);
  if (best == attribution.terms.end() || !(best->flip <= (1 - kLeastExplained) * attribution.flip)) return std::nullopt;
  return *best;
}

std::string describeCause(const compare::Attribution& attribution, const std::string& reference) {
  const std::string flip = compare::formatFigure("flip.mean", attribution.flip);
  if (flip == compare::formatFigure("flip.mean", 0)) return {};
  const std::optional<compare::TermEffect> best = findCause(attribution);
  if (!best) return kNoSingleTerm;
  return fmt::format("{}: FLIP {} -> {} with the {} term", termWithWords(best->term), flip,
                     compare::formatFigure("flip.mean", best->flip), titleOf(reference));
}

std::string describeCauses(const MaterialResult& material, const std::string& reference) {
  std::string words = material.attribution ? describeCause(*material.attribution, reference) : "";
  if (material.explanation && !material.explanation->words.empty())
    words += (words.empty() ? "" : "; ") + material.explanation->words;
  return words;
}

} // namespace parity::report
