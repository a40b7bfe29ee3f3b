// parity diff: one scene, or the chosen ones of a suite: a table with one row a material.
#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/report_parts.h"
#include "cli/requests.h"
#include "job/context.h"
#include "job/report_run.h"
#include "job/scene_work.h"

namespace parity::cli {

namespace {

// So few rows are shown whatever their verdicts are: who compares one scene wants to see its figures.
constexpr std::size_t kRowsOfAScreen = 24;

std::size_t countRows(const report::Report& report) {
  return report::countVerdicts(report).total() + report::countWholes(report).total();
}

} // namespace

int runDiffCommand(const DiffCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  std::vector<std::string> scenes;
  if (command.suite.empty()) scenes.push_back(command.scene);
  RunRequest run = runRequest(command.common, scenes, command.suite);
  job::ReportRequest request;
  request.scenes = std::move(run.scenes);
  request.suiteBudgets = run.suiteBudgets;
  request.only = run.only;
  request.suite = run.suite;
  request.commandLine = commandLine;
  request.oneOfMany = true;
  request.baseline = command.verdict.baseline;
  request.approvals = command.verdict.approvals;
  request.asOf = command.verdict.asOf;
  request.findEarlier = findEarlierRuns(command.verdict.history);
  request.explain = explainerOf(command.verdict);
  std::vector<NamedFile> inputs = inputFiles(command.common, command.verdict, request.scenes);
  inputs.push_back({"the suite", command.suite});
  inputs.push_back({"the suite's budgets", request.suiteBudgets.value_or("")});
  requireSeparate(
      {{"--json", command.common.json}, {"--csv", command.csv}, {"--summary", command.verdict.summary.file}}, inputs);
  // Of one scene nothing is finished before it is.
  std::optional<base::StopSignal> stop;
  if (request.scenes.size() > 1)
    stop.emplace("interrupted: the table shows what is finished; another signal ends the program at once");
  job::chooseCompilerEffort(request.scenes);
  job::Context context(run.settings);
  if (stop) context.stopWhen(base::StopSignal::received);
  const job::ReportResult result = job::runReport(context, request, makeProgress(command.common.quiet));
  if (!command.common.json.empty()) writeJson(command.common.json, report::toJson(result.report));
  writeCsv(command.csv, result.report);
  const bool stdoutTaken = command.common.json == "-" || command.csv == "-";
  const auto hasFailed = [](const report::SceneResult& scene) { return !scene.error.empty(); };
  const bool isSaid = std::ranges::all_of(result.report.scenes, hasFailed); // by the error lines
  const bool isShown = !stdoutTaken && !command.common.quiet && !isSaid;
  if (isShown)
    printTable(result.report, result.run, command.verdict.allRows || countRows(result.report) <= kRowsOfAScreen);
  printAnnotations(command.verdict.annotate, result.report, stdoutTaken);
  if (command.common.timings) printTimings(result.run.timings);
  return tellOutcome(result, command.verdict, isShown);
}

} // namespace parity::cli
