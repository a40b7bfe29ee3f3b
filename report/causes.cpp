#include "report/causes.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "compare/verdict/wording.h"
#include "report/term_words.h"
#include "report/wording.h"

namespace parity::report {
namespace {

constexpr double kLeastFlip = 0.0005; // below it reads 0.000: there is no cause to name

bool anyCheckFound(const MaterialResult& material) {
  return std::ranges::any_of(material.checks,
                             [](const auto& check) { return check.verdict >= compare::Verdict::warn; });
}

// Whether FLIP says something of a term at all.
bool hasFlipToExplain(const MaterialResult& material) {
  return material.figures.pixels > 0 && material.figures.nonFinite == 0 && material.verdict != compare::Verdict::error;
}

std::string wordsOf(const MaterialResult& material) {
  const std::optional<compare::TermEffect> cause = causeOf(material);
  return cause ? termWithWords(cause->term) : describeNoCause(material);
}

double flipOf(const MaterialResult& material) { return material.figures.find("flip.mean").value_or(-1); }

} // namespace

std::optional<compare::TermEffect> causeOf(const MaterialResult& material) {
  if (!hasFlipToExplain(material) || !material.attribution || material.attribution->flip < kLeastFlip) return {};
  return findCause(*material.attribution);
}

std::string describeNoCause(const MaterialResult& material) {
  if (material.seenElsewhere) return "another view shows it";
  if (material.figures.pixels == 0) return "not seen in any view";
  if (material.figures.nonFinite > 0) return "NaN or infinite pixels";
  if (material.verdict == compare::Verdict::error) return "could not be judged";
  if (material.attribution) return kNoSingleTerm;
  if (material.isExternal) return "a picture of another engine, whose terms are not known";
  if (!anyCheckFound(material)) {
    if (!material.notModelled.empty())
      return fmt::format("base layer only: parity does not model {}", fmt::join(material.notModelled, ", "));
    if (!compare::describeClipping(material.figures).empty()) return "black or white in both pictures";
    if (material.baseline && !material.baseline->notComparable.empty()) return "not comparable to the baseline";
  }
  return kCauseNotMeasured;
}

std::vector<CauseTotal> totalsByCause(const Report& report) {
  std::vector<CauseTotal> totals;
  std::set<std::pair<std::string, const void*>> counted; // cause, and the material's first row with it
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views)
      for (std::size_t i = 0; i < view.materials.size(); ++i) {
        const MaterialResult& material = view.materials[i];
        if (material.verdict < compare::Verdict::warn || material.seenElsewhere) continue;
        const std::string words = wordsOf(material);
        auto total = std::ranges::find(totals, words, &CauseTotal::words);
        if (total == totals.end()) total = totals.insert(total, {words, 0, &scene, &view, &material});
        // The same place in each view of a scene is the same material.
        const void* identity = i < scene.views.front().materials.size()
                                   ? static_cast<const void*>(&scene.views.front().materials[i])
                                   : &material;
        if (counted.emplace(words, identity).second) ++total->materials;
        if (flipOf(material) > flipOf(*total->worst))
          total->scene = &scene, total->view = &view, total->worst = &material;
      }
  // What is not known helps least.
  std::ranges::stable_sort(totals, [](const CauseTotal& a, const CauseTotal& b) {
    return std::pair(a.words != kCauseNotMeasured, a.materials) > std::pair(b.words != kCauseNotMeasured, b.materials);
  });
  return totals;
}

} // namespace parity::report
