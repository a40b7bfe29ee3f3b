// index.html: what a reader sees at once, and the data that the dashboard (report/dashboard) makes the rest of: the
// report and the run without their scenes, and the list of all rows (report/overview.h).
#pragma once

#include <string>
#include <vector>

#include "report/data_page.h"
#include "report/earlier_runs.h"
#include "report/report.h"

namespace parity::report {

// A sweep that goes with a report; both are empty where none does.
struct Bench {
  std::string json;  // bench.json of `parity bench`
  std::string plots; // JSON, too: the pictures of its scenes (study/sweep/pareto_svg.h)
};

struct PageRequest {
  const Bench& bench;
  bool singleFile = false;     // else dashboard.js, dashboard.css, the scenes' files (report/scene_file.h) and all that
                               // the report names lie beside the page
  std::vector<PageFile> files; // that a single file holds
  const EarlierRuns* earlier = nullptr; // null: no earlier run is known
};

// Piece by piece. Without scripts it shows the verdict and a table of what is over budget.
void writeHtml(const Report& report, const RunInfo& run, const PageRequest& request, const base::TextSink& sink);
std::string toHtml(const Report& report, const RunInfo& run, const PageRequest& request);

} // namespace parity::report
