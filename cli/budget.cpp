// parity budget: limits proposed from what was observed, and what a budget file says.
#include "compare/budget.h"
#include "base/file.h"
#include "base/log.h"
#include "cli/file_conflicts.h"
#include "cli/invocation.h"
#include "cli/output.h"
#include "compare/report_reader.h"
#include "compare/text.h"

namespace parity::cli {

int runBudgetSuggestCommand(const BudgetSuggestCommand& command) {
  std::vector<NamedFile> inputs;
  for (const std::string& file : command.reports) inputs.push_back({"a report", compare::reportFileOf(file)});
  requireSeparate({{"-o", command.output}}, inputs);
  std::vector<compare::ObservedRun> runs;
  for (const std::string& file : command.reports) runs.push_back({file, compare::readReport(file)});
  const compare::SuggestedBudgets suggested = compare::suggestBudgets(runs, command.options);
  for (const std::string& each : suggested.leftOut) base::logWarning("left out: " + compare::plainLine(each));
  if (command.output.empty())
    printText(base::shownStrings(suggested.text));
  else
    base::writeText(command.output, suggested.text);
  return 0;
}

int runBudgetCheckCommand(const BudgetCheckCommand& command) {
  print("{}", compare::describeBudgets(compare::loadBudgets(command.file)));
  return 0;
}

} // namespace parity::cli
