// One scene of a report: rendered, compared and judged, or recalled from the cache.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "job/report_run.h"
#include "job/run_budgets.h"
#include "job/view/view_pictures.h"
#include "report/report.h"
#include "scenes/scene.h"

namespace parity::job {

struct ComparedScene {
  report::SceneResult result;
  std::vector<EncodedPicture> pictures;   // that the result names: they are not written yet
  std::vector<scenes::SourceFile> inputs; // that it was read from, as far as it came
  double seconds = 0;                     // that it took
  double cpuSeconds = 0;                  // of all threads; 0: not known
  std::string machine = {};               // that compared it: its processor; empty: this one
  bool isCached = false;                  // taken from the cache, unchanged
  bool isMissing = false;                 // nobody has compared it: its error says why
  bool isLeftOut = false;                 // one of several of which no material was asked for: it is not in the report
  std::vector<std::string> materials;     // of one that is left out: their names
  std::string error;                      // for the log; empty: none
  std::vector<std::string> warnings;      // for the log, as the result has them but with the folders of files
};

// Told how much of the scene is done, 0..1, and what comes next.
using Tell = std::function<void(double done, const std::string& what)>;

// The scene at this place of the request. What goes wrong is the result's error; a scene that the context tells to stop
// is not run, and keeps the views that are done. Writes nothing but the cache.
ComparedScene compareScene(Context& context, const ReportRequest& request, std::size_t index, const RunBudgets& budgets,
                           const Tell& tell);

// One that an interrupted run did not begin.
ComparedScene notRunScene(const SceneRequest& request, int signal);

} // namespace parity::job
