// What verdicts rest on: the options of parity report and diff for baselines and annotations, and parity budget.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// --warn-exit, --baseline and --annotate. `verdict` must outlive the parsing.
// tableHelp: of --all.
void addVerdictOptions(CLI::App& app, VerdictOptions& verdict, const std::string& tableHelp);

// What CLI11 fills in for parity budget.
struct RawBudgetOptions {
  BudgetSuggestCommand suggest;
  BudgetCheckCommand check;
  std::string metrics;
};

// parity budget suggest and check. `raw` must outlive the parsing.
void addBudgetOptions(CLI::App& app, RawBudgetOptions& raw);

// After parsing: the subcommand that was given. Throws CLI::ParseError for what cannot be meant.
Invocation settleBudget(const CLI::App& app, const RawBudgetOptions& raw);

} // namespace parity::cli
