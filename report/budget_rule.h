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

// Adds to the notes and to what is accepted. runs: how many there are.
std::string formatRule(const RuleGroup& group, const std::vector<compare::Statistic>& figures,
                       const SuggestOptions& options, std::size_t runs, SuggestedBudgets& result);

} // namespace parity::report
