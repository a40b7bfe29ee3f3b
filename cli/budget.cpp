// parity budget: limits proposed from what was observed, and what a budget file says.
#include <fmt/format.h>

#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/text/text.h"
#include "cli/file_conflicts.h"
#include "cli/input_list.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "compare/verdict/budget.h"
#include "report/reader.h"

namespace parity::cli {

int runBudgetSuggestCommand(const BudgetSuggestCommand& command) {
  const std::vector<std::string> reports = withListed(command.reports, "report");
  std::vector<NamedFile> inputs;
  for (const std::string& file : reports) inputs.push_back({"a report", report::reportFileOf(file)});
  requireSeparate({{"-o", command.output}}, inputs);
  std::vector<report::ObservedRun> runs;
  for (const std::string& file : reports) {
    runs.push_back({file, report::readReport(file)});
    base::logDetail(fmt::format("read {}: {} scenes, by parity {} on {}", report::reportFileOf(file).string(),
                                runs.back().report.scenes.size(), runs.back().report.version,
                                runs.back().report.device));
  }
  const report::SuggestedBudgets suggested = report::suggestBudgets(runs, command.options);
  for (const std::string& each : suggested.notes) base::logWarning(base::plainLine(each));
  for (const std::string& each : suggested.faults) base::logWarning("accepted: " + base::plainLine(each));
  for (const std::string& each : suggested.accepted) base::logDetail("accepted: " + base::plainLine(each));
  if (const std::size_t count = suggested.accepted.size(); count > 0)
    base::logInfo(fmt::format("{} rule{} also accept{} what is no pass; the file says what (-v lists it here)", count,
                              count == 1 ? "" : "s", count == 1 ? "s" : ""));
  for (const std::string& each : suggested.errors) base::logError(base::plainLine(each));
  if (command.output.empty())
    printText(base::shownStrings(suggested.text));
  else
    base::writeText(command.output, suggested.text);
  return static_cast<int>(suggested.errors.empty() ? base::ExitCode::withinBudget : base::ExitCode::failed);
}

int runBudgetCheckCommand(const BudgetCheckCommand& command) {
  const compare::Budgets budgets = compare::loadBudgets(command.file);
  base::logDetail(fmt::format("read {}: with the built-in ones {} rules for materials, {} for whole images",
                              command.file, budgets.materials.size(), budgets.wholes.size()));
  print("{}", compare::describeBudgets(budgets));
  return 0;
}

} // namespace parity::cli
