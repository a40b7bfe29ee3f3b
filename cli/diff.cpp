// parity diff: one scene, a table with one row a material.
#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "job/context.h"
#include "job/report_run.h"

namespace parity::cli {

int runDiffCommand(const DiffCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  job::ReportRequest request;
  request.scenes = runRequest(command.common, {command.scene}, "").scenes;
  request.commandLine = commandLine;
  request.oneOfMany = true;
  request.baseline = command.verdict.baseline;
  requireSeparate({{"--json", command.common.json}, {"--csv", command.csv}},
                  inputFiles(command.common, command.verdict, request.scenes));
  job::Context context(command.common.settings);
  const job::ReportResult result = job::runReport(context, request, makeProgress(command.common.quiet));
  if (!command.common.json.empty()) writeJson(command.common.json, report::toJson(result.report));
  writeCsv(command.csv, result.report);
  const bool stdoutTaken = command.common.json == "-" || command.csv == "-";
  const auto hasFailed = [](const report::SceneResult& scene) { return !scene.error.empty(); };
  if (!stdoutTaken && !command.common.quiet && !std::ranges::all_of(result.report.scenes, hasFailed))
    printTable(result.report);
  printAnnotations(command.verdict.annotate, result.report, stdoutTaken);
  if (command.common.timings) printTimings(result.run.timings);
  return report::exitCode(result.report, command.verdict.warnExit);
}

} // namespace parity::cli
