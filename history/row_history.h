// How the rows of a report stand in a history: for how many runs they fail, what is fixed, what is flaky.
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "history/database.h"
#include "report/report.h"
#include "report/standing.h"

namespace parity::history {

class RowHistory {
public:
  // Of the report's suite, and of the branch of its newest run in the history. started: of the report's run (RunInfo):
  // runs since then do not count, as it may have been added already.
  RowHistory(const Database& index, const report::Report& report, const std::string& started);

  // material null: the view's whole image. What the history does not know of it (owner, what is accepted) is as
  // report::standingOf has it. A row that fails is flaky where one of the last 14 runs before it was an alarm or a
  // crash of it or of its scene.
  report::RowStanding of(const report::SceneResult& scene, const report::ViewResult& view,
                         const report::MaterialResult* material) const;

private:
  struct Known {
    std::size_t nights = 0; // for how many runs it fails, up to the newest; 0: it does not
    bool isFlaky = false;
  };
  using Key = std::tuple<std::string, std::string, std::string, int>; // scene, view, material, ordinal

  std::map<Key, Known> m_rows; // that fail, and those that an alarm was about
  bool m_isEmpty = true;       // there is no run to compare with
};

} // namespace parity::history
