// What makes a run as a whole no pass: no material was compared, or one that has to be seen is lost.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/glob.h"
#include "compare/budget.h"
#include "compare/report.h"

namespace parity::compare {
namespace {

// Scenes that could not be compared, and views of no material, are errors with a reason of their own.
bool hasOwnError(const Report& report) {
  return report.scenes.empty() || std::ranges::any_of(report.scenes, [](const SceneResult& scene) {
           return !scene.error.empty() || scene.views.empty() ||
                  std::ranges::any_of(scene.views, [](const ViewResult& view) { return view.materials.empty(); });
         });
}

// "3 not seen, 1 too small" where that is all there is; empty where any material was compared.
std::string describeNothingCompared(const Report& report) {
  if (hasOwnError(report)) return {};
  const VerdictCounts counts = countVerdicts(report);
  std::vector<std::string> parts;
  for (const auto& [count, verdict] : {std::pair{counts.notSeen, Verdict::notSeen},
                                       {counts.tooSmall, Verdict::tooSmall},
                                       {counts.notJudged, Verdict::notJudged}})
    if (count > 0) parts.push_back(fmt::format("{} {}", count, nameOf(verdict)));
  if (counts.notSeen + counts.tooSmall + counts.notJudged < counts.total()) return {};
  return fmt::format("no material was compared: {}", fmt::join(parts, ", "));
}

bool hasMaterial(const SceneResult& scene, const std::string& glob) {
  return std::ranges::any_of(scene.views, [&](const ViewResult& view) {
    return std::ranges::any_of(view.materials,
                               [&](const MaterialResult& each) { return base::matchesGlob(glob, each.name); });
  });
}

} // namespace

std::vector<RunProblem> findLost(const Budgets& budgets, const std::vector<const SceneResult*>& scenes) {
  std::vector<RunProblem> lost;
  for (const BudgetRule& rule : budgets.materials) {
    if (!rule.requireSeen) continue;
    std::vector<std::string> names;
    bool isKnown = true; // what a scene has that could not be compared is not
    for (const SceneResult* scene : scenes) {
      if (!base::matchesGlob(rule.scene, scene->name)) continue;
      names.push_back(fmt::format("'{}'", scene->name));
      isKnown = isKnown && scene->error.empty() && !hasMaterial(*scene, rule.material);
    }
    if (names.empty() || !isKnown) continue;
    constexpr std::size_t kMostNamed = 3;
    const std::string where = names.size() == 1 ? "scene " + names[0] + " has"
                              : names.size() <= kMostNamed
                                  ? fmt::format("none of the scenes {} has", fmt::join(names, ", "))
                                  : fmt::format("none of {} scenes has", names.size());
    lost.push_back({Verdict::fail,
                    fmt::format("{}: material '{}' is required to be seen (require_seen), and {} {}", rule.origin,
                                rule.material, where, names.size() == 1 ? "no such material" : "one"),
                    rule.file, rule.line});
  }
  return lost;
}

std::vector<RunProblem> problemsOf(const Report& report) {
  std::vector<RunProblem> problems = report.lost;
  if (std::string reason = describeNothingCompared(report); !reason.empty())
    problems.insert(problems.begin(), {Verdict::error, std::move(reason), "", 0});
  return problems;
}

} // namespace parity::compare
