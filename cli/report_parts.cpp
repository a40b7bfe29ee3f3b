#include "cli/report_parts.h"

#include <cstdint>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "base/day.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text/text.h"
#include "cli/again.h"
#include "cli/output.h"
#include "history/report_history.h"
#include "job/sentinels.h"
#include "report/approvals.h"
#include "report/dashboard_files.h"
#include "report/earlier_runs.h"
#include "report/standing.h"
#include "report/summary/summary.h"
#include "study/explain/report_explanation.h"
#include "study/sweep/pareto_svg.h"
#include "study/sweep/sweep_json.h"

namespace parity::cli {

namespace {

// What a mail server or a chat still takes; a browser opens more, but slowly.
constexpr std::uintmax_t kNotableBytes = 20'000'000;

std::string formatMegabytes(std::uintmax_t bytes) { return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6); }

// The size of the one file that is sent on, and how to make it smaller.
std::string describeSingleFile(const std::filesystem::path& page, bool hasPixelData) {
  const std::uintmax_t bytes = base::regularFileSize(page);
  const std::string size = formatMegabytes(bytes);
  if (bytes <= kNotableBytes) return size;
  const std::string how = hasPixelData ? "leave out --pixel-data all, or make the pictures smaller with --size"
                                       : "make the pictures smaller with --size, or give fewer scenes";
  base::logWarning(fmt::format("{} is {}; to make it smaller, {}", page.string(), size, how));
  return fmt::format("{}: larger than {}; to make it smaller, {}", size, formatMegabytes(kNotableBytes), how);
}

} // namespace

std::filesystem::path benchFile(const std::string& bench) {
  const std::filesystem::path file = bench;
  std::error_code none;
  return std::filesystem::is_directory(file, none) ? file / "bench.json" : file;
}

report::Bench readBench(const std::string& bench) {
  if (bench.empty()) return {};
  constexpr std::size_t kMaxBytes = std::size_t{64} << 20; // the page carries it
  std::string text = base::readText(benchFile(bench), kMaxBytes);
  const sweep::SweepReport sweep = sweep::readSweep(benchFile(bench));
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3); // a mark of the byte order, which JSON has none of
  return {std::move(text), sweep::paretoJson(sweep, sweep::bestKnown(sweep), sweep.figure)};
}

report::FindEarlierRuns findEarlierRuns(const std::string& folder) {
  if (folder.empty()) return {};
  return
      [folder](const report::Report& report, const report::RunInfo& run) -> std::shared_ptr<const report::EarlierRuns> {
        try {
          auto history = std::make_shared<const history::ReportHistory>(folder, report, run.startedAt);
          if (!history->knowsAny())
            base::logWarning(fmt::format("{}: the history has no earlier run of {}", folder,
                                         report.suite.empty() ? "a report without a suite" : "this suite"));
          return history;
        } catch (const base::Error& error) {
          base::logWarning(fmt::format("the history cannot be used: {}", error.what()));
          return nullptr;
        }
      };
}

job::AddToReport explainerOf(const VerdictOptions& verdict) {
  return verdict.explains ? job::AddToReport(explain::explainReport) : job::AddToReport();
}

job::ReportRequest reportRequest(const ReportCommand& command, const RunRequest& run, const std::string& commandLine) {
  if (command.singleFile && !report::hasDashboard())
    throw base::Error(base::ExitCode::usage, "--single-file", "", "this build of parity has no page index.html");
  job::ReportRequest request;
  request.scenes = run.scenes;
  request.suite = run.suite;
  request.suiteBudgets = run.suiteBudgets;
  request.baseline = command.verdict.baseline;
  request.approvals = command.verdict.approvals;
  request.asOf = command.verdict.asOf;
  request.only = run.only;
  request.pictures = command.pictures;
  request.pixelData = command.pixelData && report::hasDashboard(); // which alone reads them
  request.singleFile = command.singleFile;
  request.commandLine = commandLine;
  request.warningsFail = command.verdict.warnExit;
  request.findEarlier = findEarlierRuns(command.verdict.history);
  request.explain = explainerOf(command.verdict);
  request.again = againCommands(request.scenes, {command.suite, command.common.environments}, command.kept);
  if (command.sentinel)
    request.sentinels =
        job::chooseSentinels(request.scenes, request.asOf.empty() ? base::textOf(base::today()) : request.asOf);
  return request;
}

namespace {

// GitHub shows what a step appends to that file.
void appendStepSummary(const std::string& text) {
  const char* file = std::getenv("GITHUB_STEP_SUMMARY");
  if (!file || !*file) return;
  std::ofstream out(file, std::ios::app | std::ios::binary);
  out << text << '\n';
  out.flush();
  if (!out) throw base::fileError(file, "", "the summary cannot be appended");
}

void writeSummary(const SummaryTarget& target, const job::ReportResult& result) {
  if (target.file.empty()) return;
  const report::Summary summary =
      report::summarize(result.report, result.run, report::standingBy(result.earlier.get()));
  report::SummaryOptions options{.mostBytes = report::kMostCommentBytes, .picturesUrl = target.picturesUrl};
  base::writeText(target.file, report::toSummary(summary, target.format, options));
  options.mostBytes = report::kMostStepSummaryBytes;
  if (target.format == report::SummaryFormat::github)
    appendStepSummary(report::toSummary(summary, target.format, options));
}

// Their rows pass, so that the table does not show them.
void printExpiring(const report::Report& report) {
  const std::vector<report::ExpiringApproval> expiring = report::expiringApprovals(report);
  if (expiring.empty()) return;
  const report::ExpiringApproval& first = expiring.front();
  print("approvals that end within {} days, or have ended: {}; the first: {} of {} ({}, view {}), until {}, owner {}\n",
        compare::kToldDaysBefore, expiring.size(), first.metric,
        first.material.empty() ? "the whole image" : base::plainLine(first.material), first.scene, first.view,
        first.approval->until, base::plainLine(first.approval->owner));
}

} // namespace

int tellOutcome(const job::ReportResult& result, const VerdictOptions& verdict, bool isShown) {
  if (verdict.failOn == report::FailOn::isNew) {
    if (const std::string why = report::whyNewIsUnknown(result.report, result.earlier.get()); !why.empty())
      base::logError("--fail-on new: nobody can tell which failures are new, because " + why);
    const report::FailureCounts counts = report::countFailures(result.report, report::standingBy(result.earlier.get()));
    if (isShown)
      print("{} new failure{}, {} still failing, not counted\n", counts.isNew, counts.isNew == 1 ? "" : "s",
            counts.still);
  }
  if (isShown) printExpiring(result.report);
  writeSummary(verdict.summary, result);
  return report::exitCode(result.report, verdict.warnExit, verdict.failOn, result.earlier.get());
}

int tellReport(const job::ReportResult& result, const ReportTargets& targets) {
  const std::string singleFile =
      targets.singleFile ? describeSingleFile(targets.folder / "index.html", targets.pixelData) : std::string();
  if (!targets.json.empty()) writeJson(targets.json, report::toJson(result.report));
  writeCsv(targets.csv, result.report);
  const bool stdoutTaken = targets.json == "-" || targets.csv == "-";
  if (!stdoutTaken && !targets.quiet) {
    printTable(result.report, result.run, targets.verdict.allRows);
    printPage(targets.folder, "report.json", singleFile);
  }
  printAnnotations(targets.verdict.annotate, result.report, stdoutTaken);
  if (targets.timings) printTimings(result.run.timings);
  return tellOutcome(result, targets.verdict, !stdoutTaken && !targets.quiet);
}

} // namespace parity::cli
