// Budgets proposed from what was observed: so tight that they hold what is, and no tighter.
#pragma once

#include <string>
#include <vector>

#include "compare/report.h"

namespace parity::compare {

struct SuggestOptions {
  double margin = 0.25;                                      // share of the observed error, 0..10
  std::vector<std::string> figures{"flip.mean", "flip.p95"}; // names of statistics
};

struct ObservedRun {
  std::string source; // the report's file, for messages
  Report report;      // readReport (compare/report_reader.h)
};

// A budget file (TOML, for loadBudgets): a [[material]] rule for each material of each scene and a [[whole]] rule for
// each scene, in the order of the runs, with their exact names. Of each figure a run counts with its worst over the
// views, over interior pixels (all, where it has none); of the runs' values the 95th percentile towards the worse
// counts, which is the largest for fewer than 20 runs. `warn` is that plus the margin, `fail` plus twice the margin;
// the margin is a share of the error: of the figure where 0 is best, of its distance to the best where there is one
// (ssim), 20 log10(1 + margin) for dB. Rounded away from the best to the digits that people read. Each rule says in a
// comment and in its reason how many runs it rests on. Left out, and said in a comment: scenes that could not be
// compared, materials that no view shows, and figures that were infinite (identical images) in most runs. Throws Error
// (failed) where there is no run, a figure was not measured or is no number, or nothing is left to suggest; (usage) for
// an unknown figure, none at all, or a margin out of range.
std::string suggestBudgets(const std::vector<ObservedRun>& runs, const SuggestOptions& options);

} // namespace parity::compare
