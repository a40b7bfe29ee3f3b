// A run held against an earlier report: what changed, what is new, what is gone, and the budgets' regressions.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace parity::report {

struct BaselineOptions {
  std::string source; // the baseline's file as given; of an absolute path the report says the name alone
  std::vector<std::string> materials; // globs: only these were asked for, so others are not gone; empty: all
  bool sameScenesOnly = false;        // other scenes are not gone: this run was never to show them
  std::vector<std::string> only = {}; // globs of views (report/view_choice.h): only these were asked for; empty: all
};

// Scenes, views and materials are counterparts by their names (materials of one name by their order). Fills `baseline`
// of the report, of its whole images and of its materials, judges the regressions among their checks, and settles the
// verdicts. A regression is judged by how much worse the figure is than then: more where less is better, less where
// more is better, further from 0 where it is signed. One that was not measured then, was no number, or is of something
// that had NaN or infinite pixels then, is an error; of something that the baseline does not show it stays not judged.
// What was made under other conditions (of the run, the scene or the view; the device is one) is not comparable: it has
// no changes, its regressions stay not judged, its verdict is a warning at least, and all of them are one warning of
// the report. What the baseline has and this run has not is gone, which is a warning at least; not of scenes that could
// not be compared in either. Where the two share no material that both show, the baseline has an error: nothing was
// held against it.
void compareWithBaseline(Report& report, const Report& baseline, const BaselineOptions& options);

} // namespace parity::report
