// A report in a sentence.
#include <algorithm>

#include <fmt/format.h>

#include "report/report.h"

namespace parity::report {
namespace {

std::size_t countViews(const Report& report) {
  std::size_t views = 0;
  for (const SceneResult& scene : report.scenes) views += scene.views.size();
  return views;
}

std::string plural(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

// ", with exceptions accepted for 2 materials and a whole image"; empty where there is none.
std::string describeAccepted(const Report& report) {
  const auto [materials, wholes] = countAccepted(report);
  if (materials + wholes == 0) return {};
  const char* row = countViews(report) > 1 ? "material view" : "material";
  std::string text = ", with accepted exceptions for ";
  if (materials > 0) text += plural(materials, row, fmt::format("{}s", row).c_str());
  if (materials > 0 && wholes > 0) text += " and ";
  return text + (wholes > 0 ? plural(wholes, "whole image", "whole images") : "");
}

} // namespace

std::string headline(const Report& report) {
  const VerdictCounts counts = countVerdicts(report);
  const auto broken = std::ranges::count_if(report.scenes, [](const SceneResult& s) { return !s.error.empty(); });
  const std::string rows = countViews(report) > 1 ? "material views" : "materials";
  const std::string over = fmt::format("{} of {} {} over budget", counts.fail, counts.total(), rows);
  switch (report.verdict) {
  case compare::Verdict::pass:
    return fmt::format("All {} {} are within budget", counts.total(), rows) + describeAccepted(report);
  case compare::Verdict::notSeen:
  case compare::Verdict::tooSmall:
  case compare::Verdict::notJudged: {
    const std::size_t count = report.verdict == compare::Verdict::notSeen    ? counts.notSeen
                              : report.verdict == compare::Verdict::tooSmall ? counts.tooSmall
                                                                             : counts.notJudged;
    return fmt::format("Within budget, but {} of {} {} {}", count, counts.total(), rows, nameOf(report.verdict));
  }
  case compare::Verdict::warn:
    if (counts.warn > 0)
      return fmt::format("Within budget, with warnings for {} of {} {}", counts.warn, counts.total(), rows);
    if (countWholes(report).warn > 0) return "Within budget, with a warning for a whole image";
    return !report.baseline || report.baseline->gone.empty()
               ? fmt::format("Within budget, with {} about the run",
                             plural(report.warnings.size(), "warning", "warnings"))
               : fmt::format(
                     "Within budget, but {} missing",
                     plural(report.baseline->gone.size(), "entry of the baseline is", "entries of the baseline are"));
  case compare::Verdict::fail:
    if (counts.fail > 0) return over;
    return report.lost.empty()
               ? "A whole image is over budget"
               : fmt::format("{} that a budget requires",
                             plural(report.lost.size(), "material is missing", "materials are missing"));
  case compare::Verdict::error:
    break;
  }
  const std::vector<RunProblem> problems = problemsOf(report);
  if (report.scenes.empty() || (!problems.empty() && problems.front().verdict == compare::Verdict::error))
    return "Nothing was compared";
  if (broken == 0 && counts.error == 0 && report.baseline && !report.baseline->error.empty())
    return "The baseline could not be used";
  const std::string first = broken > 0 ? fmt::format("{} could not be compared", plural(broken, "scene", "scenes"))
                            : counts.error > 0
                                ? fmt::format("{} of {} {} could not be judged", counts.error, counts.total(), rows)
                                : "A whole image could not be judged";
  return counts.fail > 0 ? first + "; " + over : first;
}

} // namespace parity::report
