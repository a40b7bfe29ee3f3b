// parity diff: one scene, a table with one row a material.
#include <fmt/format.h>

#include "base/error.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/requests.h"
#include "job/context.h"
#include "job/report_run.h"

namespace parity::cli {

int runDiffCommand(const DiffCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  job::ReportRequest request;
  request.scenes = {sceneRequest(command.common, command.scene)};
  request.commandLine = commandLine;
  request.oneOfMany = true;
  request.baseline = command.verdict.baseline;
  requireSeparate({{"--json", command.common.json}}, inputFiles(command.common, command.verdict, request.scenes));
  job::Context context(command.common.settings);
  const job::ReportResult result = job::runReport(context, request, makeProgress(command.common.quiet));
  if (!command.common.json.empty()) writeJson(command.common.json, report::toJson(result.report));
  if (command.common.json != "-" && !command.common.quiet && result.report.scenes.front().error.empty())
    printTable(result.report);
  printAnnotations(command.verdict.annotate, result.report, command.common.json == "-");
  if (command.common.timings) printTimings(result.run.timings);
  return report::exitCode(result.report, command.verdict.warnExit);
}

} // namespace parity::cli
