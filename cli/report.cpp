// parity report: scenes or a suite in, a folder with the report out.
#include <cstdint>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/parallel.h"
#include "cli/again.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/requests.h"
#include "job/context.h"
#include "job/report_folder.h"
#include "job/report_run.h"
#include "report/dashboard_files.h"
#include "study/sweep/pareto_svg.h"
#include "study/sweep/sweep_json.h"

namespace parity::cli {

namespace {

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
  const std::vector<NamedFile> single = {{"--json", command.common.json}, {"--csv", command.csv}};
  outputs.insert(outputs.end(), single.begin(), single.end());
  requireSeparate(outputs, inputs);
  requireSeparate(single, inputFiles(command.common, command.verdict, {}));
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

// What a mail server or a chat still takes; a browser opens more, but slowly.
constexpr std::uintmax_t kNotableBytes = 20'000'000;

std::string formatMegabytes(std::uintmax_t bytes) { return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6); }

// The size of the one file that is sent on, and how to make it smaller.
std::string describeSingleFile(const std::filesystem::path& page, const job::ReportRequest& request) {
  const std::uintmax_t bytes = base::regularFileSize(page);
  const std::string size = formatMegabytes(bytes);
  if (bytes <= kNotableBytes) return size;
  const std::string how = request.pixelData ? "leave out --pixel-data all, or make the pictures smaller with --size"
                                            : "make the pictures smaller with --size, or give fewer scenes";
  base::logWarning(fmt::format("{} is {}; to make it smaller, {}", page.string(), size, how));
  return fmt::format("{}: larger than {}; to make it smaller, {}", size, formatMegabytes(kNotableBytes), how);
}

} // namespace

int runReportCommand(const ReportCommand& command, const std::string& commandLine) {
  const base::ThreadLimit threads(command.common.threads);
  RunRequest run = runRequest(command.common, withListed(command.scenes, "scene"), command.suite);
  job::ReportRequest request;
  request.scenes = std::move(run.scenes);
  request.suiteBudgets = run.suiteBudgets;
  request.folder = command.folder;
  request.commandLine = commandLine;
  request.only = run.only;
  request.suite = run.suite;
  request.again = againCommands(request.scenes, {command.suite, command.common.environments}, command.kept);
  request.baseline = command.verdict.baseline;
  request.singleFile = command.singleFile;
  request.pixelData = command.pixelData && report::hasDashboard(); // which alone reads them
  if (command.singleFile && !report::hasDashboard())
    throw base::Error(base::ExitCode::usage, "--single-file", "", "this build of parity has no page index.html");
  requireSeparateFiles(command, request);
  request.bench = readBench(command);
  const base::StopSignal stop("interrupted: the report is written with what is finished; another signal ends the "
                              "program at once");
  job::Context context(run.settings);
  context.stopWhen(base::StopSignal::received);
  const job::ReportResult result = job::runReport(context, request, makeProgress(command.common.quiet));
  const std::string singleFile =
      command.singleFile ? describeSingleFile(request.folder / "index.html", request) : std::string();
  if (!command.common.json.empty()) writeJson(command.common.json, report::toJson(result.report));
  writeCsv(command.csv, result.report);
  const bool stdoutTaken = command.common.json == "-" || command.csv == "-";
  if (!stdoutTaken && !command.common.quiet) {
    printTable(result.report, result.run, command.verdict.allRows);
    printPage(request.folder, "report.json", singleFile);
  }
  printAnnotations(command.verdict.annotate, result.report, stdoutTaken);
  if (command.common.timings) printTimings(result.run.timings);
  return report::exitCode(result.report, command.verdict.warnExit);
}

} // namespace parity::cli
