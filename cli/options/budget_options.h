// What verdicts rest on: the options of parity report and diff for baselines and annotations, and parity budget.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// --warn-exit, --baseline, --annotate, approvals and outcome. `verdict` and `raw` must outlive the parsing.
// tableHelp: of --all.
struct RawOutcome {
  std::string failOn = report::kFailOnNames[0], summaryFormat = report::kSummaryFormats[0], explain = "none";
};
void addVerdictOptions(CLI::App& app, VerdictOptions& verdict, RawOutcome& raw, const std::string& tableHelp);
// --approvals and --as-of.
void addApprovalOptions(CLI::App& app, VerdictOptions& verdict);
// --fail-on and what concerns a summary.
void addOutcomeOptions(CLI::App& app, VerdictOptions& verdict, RawOutcome& raw);
void settleOutcome(VerdictOptions& verdict, const RawOutcome& raw);
// Of a run whose baseline is its own matter: only a baseline tells what is new. Throws CLI::ValidationError.
void requireBaseline(const VerdictOptions& verdict);

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
