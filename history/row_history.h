// How the rows of a report stand in a history: for how many runs they fail, what is fixed, what is flaky.
#pragma once

#include <cstddef>
#include <map>

#include "history/database.h"
#include "history/runs_before.h"
#include "report/standing.h"

namespace parity::history {

class RowHistory {
public:
  RowHistory(const Database& index, const RunsBefore& before);

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
  const Known& find(const RowName& name) const;

  std::map<RowName, Known> m_rows; // that fail, and those that an alarm was about
  bool m_isEmpty = true;           // there is no run to compare with
};

} // namespace parity::history
