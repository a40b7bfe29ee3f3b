// parity history: runs into a history's folder, and what it says.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/day.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text/text.h"
#include "cli/commit_info.h"
#include "cli/history_parts.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "history/nights.h"
#include "history/nights_page.h"
#include "history/store.h"
#include "report/dashboard_files.h"
#include "report/reader.h"

namespace parity::cli {

std::string shownValue(double value) { return std::isnan(value) ? "no number" : fmt::format("{:.4g}", value); }

std::string describeEvents(const std::map<std::string, std::size_t>& events) {
  std::vector<std::string> parts;
  for (const char* kind : history::kEventKinds)
    if (const auto found = events.find(kind); found != events.end())
      parts.push_back(fmt::format("{} {}", found->second, kind));
  return parts.empty() ? "nothing changed" : fmt::format("{}", fmt::join(parts, ", "));
}

namespace {

using history::Store;

std::string describeEvent(const history::Event& event) {
  std::string line = fmt::format("{:<16} {}", event.kind, event.subject);
  if (!event.metric.empty())
    line += fmt::format("  {} {} -> {}", event.metric, shownValue(event.before), shownValue(event.now));
  if (event.changed > 1)
    line += fmt::format(" (and {} other figure{})", event.changed - 1, event.changed == 2 ? "" : "s");
  if (!event.cause.empty()) line += "  cause: " + event.cause;
  return line;
}

struct ReadRun {
  report::Report report;
  history::RunRecord record; // of it
};

ReadRun readRunOf(const HistoryAddCommand& command) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(std::filesystem::path(command.report) / "report.json", none))
    throw base::fileError(command.report, "", "is no folder of a report: it has no report.json");
  const report::RunInfo run = report::readRun(command.report);
  report::Report report = report::readReport(command.report);
  if (run.origin.build.empty())
    throw base::fileError(command.report, "run.json",
                          "is of an older version of parity, which does not say what made "
                          "the run; make the report again");
  history::RunRecord record = history::makeRecord(report, run, commitInfo(command.commit, command.repository));
  if (!command.suite.empty()) record.suite = command.suite;
  record.report = std::filesystem::absolute(command.report).lexically_normal().string();
  return {std::move(report), std::move(record)};
}

void tellAdded(const Store& store, const history::RunRecord& record, const history::Added& added) {
  const std::vector<history::Night> nights = history::nightsOf(store.index(), {}, 0);
  const auto night = std::ranges::find(nights, added.id, [](const history::Night& each) { return each.run.name; });
  if (night == nights.end()) return;
  std::string what = !night->isWhole  ? "a part of the scenes (--only or --material): it is kept, and not compared"
                     : night->isFirst ? "the first run of its suite and branch"
                                      : describeEvents(night->events);
  if (!record.isComplete) what += "; it is incomplete: what was not done counts as unchanged";
  print("{}: {} rows; {}\n", added.id, night->rows, what);
  constexpr std::size_t kShown = 24;
  std::size_t shown = 0;
  const std::vector<history::Event> events = history::eventsOf(store.index(), night->run.id);
  for (const char* kind : history::kEventKinds)
    for (const history::Event& event : events)
      if (event.kind == kind && shown++ < kShown) print("  {}\n", base::plainLine(describeEvent(event)));
  if (shown > kShown) print("  and {} more\n", shown - kShown);
  if (const auto alarms = night->events.find("nondeterministic"); alarms != night->events.end())
    base::logWarning(fmt::format("nondeterminism: {} row{} changed although no input, build, driver or setting did",
                                 alarms->second, alarms->second == 1 ? "" : "s"));
}

int run(const HistoryAddCommand& command) {
  auto [report, record] = readRunOf(command);
  Store store(command.folder, Store::For::writing);
  history::keepPictures(store.folder(), command.report, report, command.pictures, record);
  const history::Added added = store.add(record);
  if (added.isKnown)
    print("{}: is in the history already\n", added.id);
  else
    tellAdded(store, record, added);
  return 0;
}

int run(const HistoryRebuildCommand& command) {
  Store store(command.folder, Store::For::rebuilding);
  const std::size_t runs = store.rebuild();
  print("{}: the index is made from {} run{}\n", command.folder, runs, runs == 1 ? "" : "s");
  return 0;
}

int run(const HistoryGcCommand& command) {
  const base::Day today = command.asOf.empty() ? base::today() : base::dayFrom(command.asOf).value();
  const std::string since = base::textOf(today - std::chrono::days(command.days)) + "T00:00:00Z";
  const Store store(command.folder, Store::For::collecting);
  const history::Collected collected = history::collectPictures(
      store.index(), store.folder(), since,
      command.approvals.empty() ? compare::Approvals() : compare::loadApprovals(command.approvals), command.isTrial);
  constexpr double kMegabyte = 1e6;
  print("{}: {} pictures ({:.1f} MB) {}removed, {} ({:.1f} MB) kept\n", command.folder, collected.removed,
        static_cast<double>(collected.removedBytes) / kMegabyte, command.isTrial ? "would be " : "", collected.kept,
        static_cast<double>(collected.keptBytes) / kMegabyte);
  return 0;
}

int run(const HistoryBaselineCommand& command) {
  const Store store(command.folder, Store::For::reading);
  const std::optional<history::BaselineRun> found =
      history::findBaseline(store.index(), history::Git(command.repository), command.question);
  if (!found)
    throw base::fileError(
        command.folder, "",
        fmt::format("has no whole, complete run without an error of a commit that '{}' and '{}' have in common",
                    command.question.into, command.question.commit));
  if (command.print != "run" && report::readRun(found->report).startedAt != found->run.started)
    throw base::fileError(found->report, "",
                          fmt::format("holds another run by now; {} was here when it was added (--print run prints "
                                      "its name)",
                                      found->run.name));
  if (command.print != "report") print("{}\n", found->run.name);
  if (command.print != "run") print("{}\n", found->report);
  return 0;
}

int run(const HistoryPageCommand& command) {
  if (!report::hasDashboard())
    throw base::Error(base::ExitCode::usage, "history page", "", "this build of parity has no page index.html");
  const Store store(command.folder, Store::For::reading);
  const std::filesystem::path folder = command.output;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw base::fileError(command.output, "", "cannot be created as a folder: " + error.message());
  if (std::filesystem::exists(folder / "report.json", error))
    throw base::fileError(command.output, "report.json",
                          "a report lies here, whose page would be lost; give another folder");
  base::writeText(folder / "index.html", history::toNightsPage(store.index(), command.where, command.last));
  print("{}\n", (folder / "index.html").string());
  return 0;
}

int run(const HistoryShowCommand& command) { return showHistory(command); }
int run(const HistoryBlameCommand& command) { return blameHistory(command); }
int run(const HistoryStepCommand& command) { return stepHistory(command); }

} // namespace

int runHistoryCommand(const HistoryCommand& command) {
  return std::visit([](const auto& each) { return run(each); }, command);
}

} // namespace parity::cli
