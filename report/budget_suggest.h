// Budgets proposed from what was observed: so tight that they hold what is, and no tighter.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace parity::report {

struct SuggestOptions {
  double margin = 0.25;                                      // share of the observed error, 0..10
  std::vector<std::string> figures{"flip.mean", "flip.p95"}; // names of statistics
};

struct ObservedRun {
  std::string source; // the report's file, for messages
  Report report;      // readReport (report/reader.h)
};

struct SuggestedBudgets {
  std::string text;                 // a budget file (TOML)
  std::vector<std::string> leftOut; // what it does not limit and why, one line each; also in the text, as comments
};

// A budget file for loadBudgets: a [[material]] rule for each material of each scene and a [[whole]] rule for
// each scene, in the order of the runs, with their exact names. Of each figure a run counts with its worst over the
// views; of the runs' values the 95th percentile towards the worse
// counts, which is the largest for fewer than 20 runs. `warn` is that plus the margin, `fail` plus twice the margin;
// the margin is a share of the error: of the figure where 0 is best, of its distance to the best where there is one
// (ssim), 20 log10(1 + margin) for dB. Rounded away from the best to the digits that people read. Each rule says in a
// comment and in its reason how many runs it rests on. Equal reports count as one run. Left out, and said: scenes that
// could not be compared, materials that no view shows, materials and whole images with NaN or infinite pixels in any
// run, figures that were infinite (identical images) in most runs, and limits at the end of a figure's range, which
// nothing could be beyond. Throws Error (failed) where there is no run, a figure was not measured or is no number, or
// nothing is left to suggest; (usage) for an unknown figure, none at all, or a margin out of range.
SuggestedBudgets suggestBudgets(const std::vector<ObservedRun>& runs, const SuggestOptions& options);

} // namespace parity::report
