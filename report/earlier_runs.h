// What a history of earlier runs knows of a report's rows, for the report's page, its summary and its exit code.
// history/report_history.h has it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "report/report.h"
#include "report/standing.h"

namespace parity::report {

// A picture of an approved state, which the report's folder holds, too.
struct ApprovedPicture {
  std::string file;             // relative to the report's folder: "approved/9f3c....png"
  std::filesystem::path source; // in the history
};

class EarlierRuns {
public:
  virtual ~EarlierRuns() = default;

  // Whether there is a run that the report can be held against.
  virtual bool knowsAny() const = 0;
  // material null: the view's whole image. The scene and its parts are those of the report that this was made for.
  virtual RowStanding standingOf(const SceneResult& scene, const ViewResult& view,
                                 const MaterialResult* material) const = 0;
  // JSON on one line, as the page reads it (report/dashboard/src/data/history.ts): EarlierRuns, and of a scene
  // SceneTrends. Several threads may ask at a time.
  virtual std::string runsJson() const = 0;
  virtual std::string trendsJson(const SceneResult& scene) const = 0;
  virtual std::vector<ApprovedPicture> approvedPictures() const = 0;
};

// Opens a history for a report that is finished but for its page. Null: it cannot be used, which has been said.
using FindEarlierRuns = std::function<std::shared_ptr<const EarlierRuns>(const Report&, const RunInfo&)>;

// The standing of a row by these runs; null: by the baseline alone.
FindStanding standingBy(const EarlierRuns* earlier);

} // namespace parity::report
