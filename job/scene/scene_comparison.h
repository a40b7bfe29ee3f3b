// One scene of a report: rendered, compared and judged, or recalled from the cache.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/verdict/budget.h"
#include "job/report_run.h"
#include "job/view/view_pictures.h"
#include "report/report.h"

namespace parity::job {

// Budgets that go before a scene's own, and those that stand in where it has none.
struct RunBudgets {
  std::optional<compare::Budgets> first;
  compare::Budgets otherwise;
  const report::Report* baseline = nullptr; // that the run will be held against; null: none
};

struct ComparedScene {
  report::SceneResult result;
  std::vector<EncodedPicture> pictures; // for a report in a single file; else they are written already
  bool isCached = false;                // taken from the cache, unchanged
  bool isLeftOut = false;               // one of several of which no material was asked for: it is not in the report
  std::vector<std::string> materials;   // of one that is left out: their names
  std::string error;                    // for the log; empty: none
  std::vector<std::string> warnings;    // for the log, as the result has them but with the folders of files
};

// Told how much of the scene is done, 0..1, and what comes next.
using Tell = std::function<void(double done, const std::string& what)>;

// The scene at this place of the request. What goes wrong is the result's error; a scene that the context tells to stop
// is not run, and keeps the views that are done. Pictures are written to the request's
// folder, unless it wants a single file.
ComparedScene compareScene(Context& context, const ReportRequest& request, std::size_t index, const RunBudgets& budgets,
                           const Tell& tell);

// One that an interrupted run did not begin.
ComparedScene notRunScene(const SceneRequest& request, int signal);

} // namespace parity::job
