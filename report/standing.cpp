#include "report/standing.h"

#include "report/earlier_runs.h"

namespace parity::report {
namespace {

// An approval that the row passes by, or would.
const compare::AppliedApproval* approvalOf(const std::vector<compare::CheckResult>& checks) {
  for (const compare::CheckResult& check : checks)
    if (check.approval && check.judged() && check.verdict >= compare::Verdict::warn) return &*check.approval;
  return nullptr;
}

RowStanding standingOf(compare::Verdict now, const std::string& accepted, const compare::AppliedRule& rule,
                       const std::vector<compare::CheckResult>& checks, const std::optional<BaselineChange>& baseline) {
  const compare::AppliedApproval* approval = approvalOf(checks);
  RowStanding row{Standing::none, 0, approval ? approval->owner : rule.owner};
  const bool failed = baseline && !baseline->isNew && isFailure(baseline->before);
  if (isFailure(now))
    row.standing = !baseline ? Standing::unknown : failed ? Standing::still : Standing::isNew;
  else if (!accepted.empty())
    row.standing = Standing::accepted;
  else if (failed && (now == compare::Verdict::pass || now == compare::Verdict::warn))
    row.standing = Standing::fixed;
  return row;
}

} // namespace

const char* nameOf(Standing standing) {
  switch (standing) {
  case Standing::none:
    return "as before";
  case Standing::unknown:
    return "failing";
  case Standing::isNew:
    return "new";
  case Standing::still:
    return "still failing";
  case Standing::fixed:
    return "fixed";
  case Standing::accepted:
    return "accepted";
  case Standing::flaky:
    return "flaky";
  }
  return "as before";
}

bool isFailure(compare::Verdict verdict) {
  return verdict == compare::Verdict::fail || verdict == compare::Verdict::error;
}

RowStanding standingOf(const ViewResult& view, const MaterialResult* material) {
  if (!material) return standingOf(view.wholeVerdict, view.accepted, view.rule, view.checks, view.baseline);
  if (material->seenElsewhere) return {};
  return standingOf(material->verdict, material->accepted, material->rule, material->checks, material->baseline);
}

FailureCounts countFailures(const Report& report, const FindStanding& find) {
  FailureCounts counts{report.lost.size(), 0};
  const auto add = [&](const RowStanding& row) {
    counts.isNew += row.standing == Standing::isNew || row.standing == Standing::unknown;
    counts.still += row.standing == Standing::still || row.standing == Standing::flaky;
  };
  for (const SceneResult& scene : report.scenes)
    for (const ViewResult& view : scene.views) {
      add(find ? find(scene, view, nullptr) : standingOf(view, nullptr));
      for (const MaterialResult& material : view.materials)
        add(find ? find(scene, view, &material) : standingOf(view, &material));
    }
  return counts;
}

FindStanding standingBy(const EarlierRuns* earlier) {
  if (!earlier) return {};
  return [earlier](const SceneResult& scene, const ViewResult& view, const MaterialResult* material) {
    return earlier->standingOf(scene, view, material);
  };
}

std::string whyNewIsUnknown(const Report& report, const EarlierRuns* earlier) {
  if (earlier && earlier->knowsAny()) return "";
  if (!report.baseline) return "there is no baseline";
  if (!report.baseline->error.empty()) return "the baseline cannot be used: " + report.baseline->error;
  return report.baseline->notWhole.empty() ? "" : "the baseline is not complete: " + report.baseline->notWhole;
}

} // namespace parity::report
