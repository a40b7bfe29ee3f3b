// A scene's part of report.json and run.json as a file that a page can load without a server, as report/pixel_chunk.h
// does: one JavaScript statement.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "report/earlier_runs.h"
#include "report/report.h"

namespace parity::report {

// Of all scenes of a report, each by its place there. All must outlive it.
class SceneFiles {
public:
  // earlier: null: no earlier run is known.
  SceneFiles(const Report& report, const RunInfo& run, const EarlierRuns* earlier);

  // "scenes/12.js", relative to the report's folder.
  static std::string nameOf(std::size_t place);

  // {"file":FILE,"format":1,"scene":{...},"again":[...],"history":{...}}: the scene as report.json has it, the commands
  // of its views as run.json has them, and what earlier runs know of its rows, where there are some; no times, so that
  // the same scenes give the same bytes. Several threads may ask at a time.
  std::string object(std::size_t place) const;

  // The file's text: parityScene(OBJECT);
  std::string script(std::size_t place) const;

private:
  const std::vector<SceneResult>& m_scenes;
  const EarlierRuns* m_earlier;
  std::unordered_map<std::string_view, std::vector<const AgainCommand*>> m_again; // by scene
};

} // namespace parity::report
