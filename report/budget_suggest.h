// Budgets proposed from what was observed: so tight that they hold what is, and no tighter.
#pragma once

#include <string>
#include <vector>

#include "report/budget_observation.h"

namespace parity::report {

struct SuggestOptions {
  double margin = 0.25;                                      // share of the observed error, 0..10
  std::vector<std::string> figures{"flip.mean", "flip.p95"}; // names of statistics
  bool perScene = false;                                     // a rule for each scene and material
  bool regress = false; // limits on how much worse than in a baseline, in place of limits on the figures
};

struct SuggestedBudgets {
  std::string text;                  // a budget file (TOML)
  std::vector<std::string> notes;    // what it does not limit and why, one line each; also in the text, as comments
  std::vector<std::string> accepted; // what its rules accept although it is no pass: the same
  std::vector<std::string> faults;   // of these: NaN, which is a fault of a renderer and has to be said aloud
  std::vector<std::string> errors;   // what no rule can accept: an unchanged run is an error again. The same
};

// A budget file for loadBudgets, under which each of these runs, unchanged, passes: a [[material]] rule for each
// material, and a [[whole]] rule, with limits that hold in all scenes (budget_limits.h, from the worst scene and view
// of each run); perScene: for each scene, too. What warns, and what no limit can hold, is accepted by name and with a
// reason (compare/verdict/accept.h). NaN pixels and figures without any limit are accepted of the one scene that has
// them. A material of which nothing is known (not seen, too small, NaN in all views) gets the built-in limits. Each
// rule says in a comment and in its reason how many runs it rests on. Equal reports count as one run. Throws Error
// (failed) where there is no run, a figure was not measured or is no number, or no material was compared in any run;
// (usage) for an unknown figure, none at all, or a margin out of range.
SuggestedBudgets suggestBudgets(const std::vector<ObservedRun>& runs, const SuggestOptions& options);

} // namespace parity::report
