// parity report: scenes or a suite in, a folder with the report out.
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/requests.h"
#include "job/context.h"
#include "job/report_folder.h"
#include "job/report_run.h"
#include "report/dashboard_files.h"
#include "study/sweep/pareto_svg.h"
#include "study/sweep/sweep_json.h"

namespace parity::cli {

namespace {

// settings: those of the run, of scenes that say nothing else.
job::ReportRequest makeRequest(const ReportCommand& command, job::Settings& settings) {
  job::ReportRequest request;
  if (!command.suite.empty()) {
    const scenes::Suite suite = scenes::loadSuite(command.suite, job::suiteKnobs());
    request.suiteBudgets = suite.budgets;
    settings = job::defaultsOf(suite, command.common.plain, command.common.given);
    request.scenes = job::requestsOf(suite, command.common.plain, command.common.given);
    return request;
  }
  std::set<std::string> names;
  for (const std::string& scene : command.scenes) {
    job::SceneRequest entry = sceneRequest(command.common, scene);
    for (int copy = 2; !names.insert(entry.name).second; ++copy)
      entry.name = fmt::format("{} ({})", sceneRequest(command.common, scene).name, copy);
    request.scenes.push_back(entry);
  }
  return request;
}

std::filesystem::path benchFile(const ReportCommand& command) {
  const std::filesystem::path file = command.bench;
  std::error_code none;
  return std::filesystem::is_directory(file, none) ? file / "bench.json" : file;
}

// The baseline may lie in the report's own folder, as it is read first; all else that is read must stay.
void requireSeparateFiles(const ReportCommand& command, const job::ReportRequest& request) {
  std::vector<NamedFile> inputs = inputFiles(command.common, request.scenes);
  inputs.push_back({"the suite", command.suite});
  inputs.push_back({"the suite's budgets", request.suiteBudgets.value_or("")});
  inputs.push_back({"--bench", benchFile(command)});
  std::vector<NamedFile> outputs;
  for (const char* file : job::kReportFiles) outputs.push_back({"-o", request.folder / file});
  outputs.push_back({"--json", command.common.json});
  requireSeparate(outputs, inputs);
  requireSeparate({outputs.back()}, inputFiles(command.common, command.verdict, {}));
}

// What it is is known here, and anything else refused, before anything is rendered.
report::Bench readBench(const ReportCommand& command) {
  if (command.bench.empty()) return {};
  constexpr std::size_t kMaxBytes = std::size_t{64} << 20; // the page carries it
  std::string text = base::readText(benchFile(command), kMaxBytes);
  const sweep::SweepReport sweep = sweep::readSweep(benchFile(command));
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3); // a mark of the byte order, which JSON has none of
  return {std::move(text), sweep::paretoJson(sweep, sweep::bestKnown(sweep), sweep.figure)};
}

} // namespace

int runReportCommand(const ReportCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  job::Settings settings = command.common.settings;
  job::ReportRequest request = makeRequest(command, settings);
  request.folder = command.folder;
  request.commandLine = commandLine;
  request.baseline = command.verdict.baseline;
  request.singleFile = command.singleFile;
  request.pixelData = command.pixelData && report::hasDashboard(); // which alone reads them
  if (command.singleFile && !report::hasDashboard())
    throw base::Error(base::ExitCode::usage, "--single-file", "", "this parity was built without the page index.html");
  requireSeparateFiles(command, request);
  request.bench = readBench(command);
  job::Context context(settings);
  const job::ReportResult result = job::runReport(context, request, makeProgress(command.common.quiet));
  if (!command.common.json.empty()) writeJson(command.common.json, report::toJson(result.report));
  if (command.common.json != "-" && !command.common.quiet) {
    printTable(result.report);
    printPage(request.folder, "report.json");
  }
  printAnnotations(command.verdict.annotate, result.report, command.common.json == "-");
  if (command.common.timings) printTimings(result.run.timings);
  return report::exitCode(result.report, command.verdict.warnExit);
}

} // namespace parity::cli
