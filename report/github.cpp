// GitHub annotations: one workflow command a row that is not well, at the line of the budget rule that said so.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/text/github_command.h"
#include "compare/verdict/wording.h"
#include "report/report.h"
#include "report/wording.h"

namespace parity::report {
namespace {

struct Annotation {
  compare::Verdict verdict;
  std::string title, message; // the message may have several lines
  std::string file = {};      // of the budget rule; empty: none
  int line = 0;
};

std::string format(const Annotation& annotation, const std::filesystem::path& root) {
  return base::toText({annotation.verdict >= compare::Verdict::fail, annotation.title, annotation.message,
                       annotation.file, annotation.line},
                      root);
}

std::string describe(compare::Verdict verdict, const std::string& reason, const compare::Figures& figures,
                     const ViewResult& view, const compare::AppliedRule& rule, const std::string& cause) {
  std::string message = fmt::format("{}: {}", nameOf(verdict), reason);
  if (figures.pixels > 0) message += "\n" + compare::describeBias(figures, view.test);
  if (!cause.empty()) message += "\nCause: " + cause;
  if (!rule.reason.empty()) message += "\nReason for the budget: " + rule.reason;
  if (!rule.owner.empty()) message += "\nOwner: " + rule.owner;
  return message;
}

std::vector<Annotation> collect(const Report& report) {
  std::vector<Annotation> all;
  if (report.scenes.empty()) all.push_back({compare::Verdict::error, "parity", "nothing was compared"});
  if (report.baseline) {
    if (!report.baseline->error.empty())
      all.push_back({compare::Verdict::error, "parity: baseline", report.baseline->error});
    for (const GoneRow& row : report.baseline->gone)
      all.push_back({compare::Verdict::warn, "parity: baseline", describeGone(row)});
  }
  for (const RunProblem& problem : problemsOf(report))
    all.push_back({problem.verdict, "parity", problem.reason, problem.file, problem.line});
  for (const std::string& warning : report.warnings) all.push_back({compare::Verdict::warn, "parity", warning});
  for (const SceneResult& scene : report.scenes) {
    if (!scene.error.empty() && !isNotRun(scene))
      all.push_back({compare::Verdict::error, "parity: " + scene.name, scene.error});
    for (const ViewResult& view : scene.views) {
      const std::string place = fmt::format("{}, view {}", scene.name, view.name);
      if (view.wholeVerdict != compare::Verdict::pass)
        all.push_back({view.wholeVerdict, fmt::format("parity: whole image ({})", place),
                       describe(view.wholeVerdict, view.reason, view.whole, view, view.rule, ""), view.rule.file,
                       view.rule.line});
      for (const MaterialResult& material : view.materials)
        if (material.verdict != compare::Verdict::pass && !material.seenElsewhere)
          all.push_back({material.verdict, fmt::format("parity: {} ({})", material.name, place),
                         describe(material.verdict, material.reason, material.figures, view, material.rule,
                                  describeCauses(material, view.reference)),
                         material.rule.file, material.rule.line});
    }
  }
  if (countNotRun(report) > 0) all.push_back({compare::Verdict::notRun, "parity", describeNotRun(report)});
  std::ranges::stable_sort(all, std::ranges::greater{}, &Annotation::verdict);
  return all;
}

} // namespace

std::string toGithubAnnotations(const Report& report, const std::filesystem::path& root) {
  std::string out;
  for (const Annotation& annotation : collect(report)) out += format(annotation, root);
  return out;
}

} // namespace parity::report
