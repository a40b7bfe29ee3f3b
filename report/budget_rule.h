// A suggested rule of a budget file, as TOML.
#pragma once

#include <string>
#include <vector>

#include "report/budget_suggest.h"

namespace parity::report {

// What one rule is for: the subjects of one material, or whole images, that share it.
struct RuleGroup {
  std::vector<const ObservedSubject*> subjects;
  bool namesScene = false; // of its only subject
};

// By run: the worst of the subjects' errors (budget_limits.h: errorOf), without runs that say nothing.
std::vector<double> worstErrors(const RuleGroup& group, std::size_t figure, std::size_t runs);

// "warn = 0.120, fail = 0.140" for the errors of the runs; empty where no value can exceed a limit.
std::string suggestFor(const compare::Statistic& figure, const std::vector<double>& errors,
                       const SuggestOptions& options);

// Adds to the notes and to what is accepted. runs: how many there are.
std::string formatRule(const RuleGroup& group, const std::vector<compare::Statistic>& figures,
                       const SuggestOptions& options, std::size_t runs, SuggestedBudgets& result);

} // namespace parity::report
