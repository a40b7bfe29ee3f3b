// parity approve: figures of a report that are over budget, as entries of a file of approvals.
#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text/text.h"
#include "cli/file_conflicts.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "report/reader.h"

namespace parity::cli {

namespace {

constexpr std::size_t kFewRows = 20;

// Rows may have several figures.
std::size_t countRows(const std::vector<compare::Approval>& entries) {
  std::set<std::tuple<std::string, std::string, std::string>> rows;
  for (const compare::Approval& entry : entries) rows.emplace(entry.scene, entry.view, entry.material);
  return rows.size();
}

std::string plural(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

compare::Approvals readExisting(const std::string& file) {
  std::error_code none;
  if (std::filesystem::exists(file, none)) return compare::loadApprovals(file);
  return {.file = file, .head = {}, .numerics = {}, .entries = {}};
}

std::string lineOf(const compare::Approval& entry) {
  return fmt::format("  {} {} of {} ({}, view {}), slack {}\n", entry.metric, entry.value,
                     entry.material.empty() ? "the whole image" : entry.material, entry.scene, entry.view, entry.slack);
}

} // namespace

int runApproveCommand(const ApproveCommand& command) {
  const std::filesystem::path folder = command.report;
  const std::filesystem::path file = report::reportFileOf(folder);
  if (!std::filesystem::is_directory(folder))
    throw base::fileError(command.report, "", "is not the folder of a report, whose run.json is needed, too");
  requireSeparate({{"-o", command.output}}, {{"the report", file}, {"the report", folder / "run.json"}});
  compare::Approvals approvals = readExisting(command.output);
  const report::Report result = report::readReport(file, report::ReadDepth::checks);
  if (const std::string why = report::whyNotWhole(result); !why.empty())
    throw base::fileError(file.string(), "", "nothing of it is approved: " + why);
  const std::string numerics = report::readRun(folder).origin.numerics;
  if (numerics.empty())
    throw base::fileError((folder / "run.json").string(), "", "does not have the numerics id; make the report again");
  if (!approvals.numerics.empty() && approvals.numerics != numerics)
    throw base::fileError(command.output, "numerics",
                          fmt::format("its entries are of machines that round otherwise (numerics id {}, of the report "
                                      "{}); make the report on one of those, or write another file",
                                      approvals.numerics.substr(0, 8), numerics.substr(0, 8)));
  const report::ApproveResult approved = report::approveRows(result, command.request);
  for (const std::string& refused : approved.refused) base::logWarning(base::plainLine("not approved: " + refused));
  if (approved.entries.empty())
    throw base::fileError(file.string(), "", "nothing to approve: no such row is beyond a limit");
  const std::size_t rows = countRows(approved.entries);
  if (rows > kFewRows && !command.isMany)
    throw base::Error(base::ExitCode::usage, "approve", "",
                      fmt::format("{} rows would be approved; give --yes if all of them are meant", rows));
  approvals.numerics = numerics;
  const report::MergedApprovals merged = report::mergeApprovals(approvals, approved.entries);
  base::writeText(command.output, compare::formatApprovals(approvals));
  std::string text = fmt::format("{}: {} added, {} replaced, {} in all; until {}\n", command.output,
                                 plural(merged.added, "entry", "entries"), merged.replaced, approvals.entries.size(),
                                 base::textOf(command.request.until));
  for (std::size_t i = 0; i < std::min(approved.entries.size(), kFewRows); ++i) text += lineOf(approved.entries[i]);
  if (approved.entries.size() > kFewRows) text += fmt::format("  and {} more\n", approved.entries.size() - kFewRows);
  printText(text);
  return 0;
}

} // namespace parity::cli
