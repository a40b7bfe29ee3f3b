// A whole run: scenes in, report out.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "job/scene_request.h"
#include "job/settings.h"
#include "job/view/view_pictures.h"
#include "report/page.h"

namespace parity::job {

class Context;
class RunBudgets;
struct ReportRequest;

// Takes a picture of a report that is nearly finished.
using KeepPicture = std::function<void(EncodedPicture)>;

// Adds to a report that has its verdicts; pictures go to `keep`, which is empty where there are none.
using AddToReport = std::function<void(Context& context, const ReportRequest& request, const RunBudgets& budgets,
                                       report::Report& report, const KeepPicture& keep, const Progress& progress)>;

// Which views' pictures a report has, and the values behind them: of all, of those with a row that is no pass, of none.
enum class Pictures { all, notPassed, none };
inline constexpr std::array<const char*, 3> kPicturesNames = {"all", "not-passed", "none"};

struct ReportRequest {
  std::vector<SceneRequest> scenes;             // in order; each is tried, whatever becomes of the others
  std::string suite = {};                       // its name; empty: none
  std::optional<std::string> suiteBudgets;      // the suite file's own default
  std::filesystem::path folder;                 // empty: nothing is written
  std::filesystem::path baseline;               // an earlier report.json or its folder; empty: none
  std::string approvals = {};                   // a file of approvals; empty: none
  std::string asOf = {};                        // the day for them, ISO 8601; empty: today
  std::vector<std::string> only = {};           // globs by which its views were chosen of more; empty: these are all
  bool oneOfMany = false;                       // scenes of the baseline that this run does not show are not gone
  Pictures pictures = Pictures::all;            // none where there is no folder
  bool pixelData = true;                        // the values behind the pictures are written, too: pixels/
  bool singleFile = false;                      // index.html holds everything that it shows
  report::Bench bench;                          // for the page and the folder
  std::string commandLine;                      // for run.json
  std::vector<report::AgainCommand> again = {}; // for run.json
  bool warningsFail = false;                    // for run.json and junit.xml
  report::FindEarlierRuns findEarlier = {};     // for the page; empty: no history
  AddToReport explain = {};                     // explains materials over budget; empty: it is not asked for
  std::vector<std::size_t> sentinels = {}; // places of scenes that are compared although the cache has them, in order
};

struct ReportResult {
  report::Report report;
  report::RunInfo run;
  std::shared_ptr<const report::EarlierRuns> earlier = {}; // what the request's findEarlier has found
};

// Compares every view of every scene. A scene that fails is an error in the report, with its reason, and the next one
// runs. Once the context is told to stop, the scenes that are not done are `not run`, and the report is finished. Of
// several scenes those without a material that was asked for are not in the report; a glob that matches in none of them
// is a problem of the run. With a folder: what job/report_folder.h says is written there, whatever the
// verdict. A baseline may lie in that same folder: it is read first. Throws Error for what concerns the whole run: no
// device, a budget file or a baseline that cannot be used, a folder that cannot be written.
ReportResult runReport(Context& context, const ReportRequest& request, const Progress& progress);

} // namespace parity::job
