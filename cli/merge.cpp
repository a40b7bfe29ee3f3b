// parity merge: the units of a plan in, the report out.
#include "job/plan/merge.h"
#include <optional>

#include "base/error.h"
#include "base/interrupt.h"
#include "cli/invocation.h"
#include "cli/progress.h"
#include "cli/report_parts.h"
#include "job/plan/plan_folder.h"
#include "job/scene_work.h"

namespace parity::cli {

int runMergeCommand(const MergeCommand& command) {
  const job::Plan plan = job::readPlan(command.plan);
  if (command.verdict.failOn == report::FailOn::isNew && plan.request.baseline.empty() &&
      command.verdict.history.empty())
    throw base::Error(base::ExitCode::usage, "--fail-on", "'new'",
                      "needs --history, or a plan with --baseline, which says what failed before");
  const job::PlanLock lock(command.plan);
  std::optional<base::StopSignal> stop;
  if (command.verdict.explains)
    stop.emplace("interrupted: the report is written with what is explained; another signal ends the program at once");
  job::chooseCompilerEffort(plan.request.scenes); // a report that explains has a device
  const job::ReportResult result =
      job::mergePlan(plan, command.plan,
                     {.folder = command.folder,
                      .incomplete = command.reportsIncomplete ? job::Incomplete::report : job::Incomplete::error,
                      .bench = readBench(command.bench),
                      .warningsFail = command.verdict.warnExit,
                      .approvals = command.verdict.approvals,
                      .asOf = command.verdict.asOf,
                      .findEarlier = findEarlierRuns(command.verdict.history),
                      .explain = explainerOf(command.verdict),
                      .isStopped = base::StopSignal::received},
                     makeProgress(command.quiet));
  return tellReport(result, {.folder = command.folder,
                             .singleFile = plan.request.singleFile,
                             .pixelData = plan.request.pixelData,
                             .json = command.json,
                             .csv = command.csv,
                             .timings = command.timings,
                             .quiet = command.quiet,
                             .verdict = command.verdict});
}

} // namespace parity::cli
