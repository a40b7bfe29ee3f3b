// What makes a run as a whole no pass, or no whole run.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/report.h"

namespace parity::report {
namespace {

// Scenes that could not be compared, and views of no material, are errors with a reason of their own.
bool hasOwnError(const Report& report) {
  return report.scenes.empty() || std::ranges::any_of(report.scenes, [](const SceneResult& scene) {
           return !scene.error.empty() || scene.views.empty() ||
                  std::ranges::any_of(scene.views, [](const ViewResult& view) { return view.materials.empty(); });
         });
}

// Whether the budget accepts a material of which too little was there to compare.
bool isAcceptedUncompared(const MaterialResult& material) {
  const compare::Figures& figures = material.figures;
  if (material.verdict != compare::Verdict::pass || material.accepted.empty()) return false;
  return figures.nonFinite > 0 || figures.pixels < std::max<std::uint64_t>(material.rule.minPixels, 1) ||
         figures.clipped() > compare::kMostClipping;
}

std::size_t countAcceptedUncompared(const Report& report) {
  std::size_t count = 0;
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views)
      count += static_cast<std::size_t>(std::ranges::count_if(view.materials, isAcceptedUncompared));
  return count;
}

// "3 not seen, 1 too small" where that is all there is; empty where any material was compared.
std::string describeNothingCompared(const Report& report) {
  if (hasOwnError(report)) return {};
  const VerdictCounts counts = countVerdicts(report);
  std::vector<std::string> parts;
  for (const auto& [count, verdict] : {std::pair{counts.notSeen, compare::Verdict::notSeen},
                                       {counts.tooSmall, compare::Verdict::tooSmall},
                                       {counts.notJudged, compare::Verdict::notJudged}})
    if (count > 0) parts.push_back(fmt::format("{} {}", count, nameOf(verdict)));
  const std::size_t accepted = countAcceptedUncompared(report);
  if (accepted > 0) parts.push_back(fmt::format("{} accepted without being judged", accepted));
  if (counts.notSeen + counts.tooSmall + counts.notJudged + accepted < counts.total()) return {};
  return fmt::format("no material was compared: {}", fmt::join(parts, ", "));
}

// Empty where any limit was judged, or no row is a warning because the baseline allows none to be.
std::string describeNothingJudged(const Report& report) {
  if (hasOwnError(report) || !report.baseline || !report.baseline->error.empty()) return {};
  bool isAnyLeft = false, isAnyJudged = false;
  const auto add = [&](compare::Verdict verdict, const std::vector<compare::CheckResult>& checks) {
    isAnyJudged = isAnyJudged || std::ranges::any_of(checks, &compare::CheckResult::judged);
    isAnyLeft = isAnyLeft || (verdict == compare::Verdict::warn && !checks.empty() &&
                              std::ranges::all_of(checks, &compare::CheckResult::regress));
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      add(view.wholeVerdict, view.checks);
      for (const MaterialResult& material : view.materials) add(material.verdict, material.checks);
    }
  if (isAnyJudged || !isAnyLeft) return {};
  return "no limit was judged: the budgets limit only regressions, and the baseline has no comparable figures";
}

} // namespace

std::string whyNotWhole(const Report& report) {
  if (!report.only.empty()) return "it shows a part of the views (--only)";
  for (const compare::Condition& condition : report.conditions)
    if (condition.name == "materials" && condition.value != "all")
      return "it shows a part of the materials (--material)";
  std::size_t count = 0;
  const SceneResult* first = nullptr;
  for (const SceneResult& scene : report.scenes)
    if (!scene.error.empty() || scene.views.empty()) {
      first = first ? first : &scene;
      ++count;
    }
  if (report.scenes.empty()) return "it has no scene";
  if (count == 0) return {};
  return fmt::format("{} of {} scenes {} no result: '{}'{}", count, report.scenes.size(), count == 1 ? "has" : "have",
                     first->name, first->error.empty() ? "" : ": " + first->error);
}

std::vector<RunProblem> problemsOf(const Report& report) {
  std::vector<RunProblem> problems = report.lost;
  for (std::string reason : {describeNothingCompared(report), describeNothingJudged(report)})
    if (!reason.empty()) problems.insert(problems.begin(), {compare::Verdict::error, std::move(reason), "", 0});
  return problems;
}

} // namespace parity::report
