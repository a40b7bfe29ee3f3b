// "To see it again": the command for one row.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "report/report.h"

namespace parity::report {

// The commands of a run, by scene and view. The run must outlive it.
class AgainCommands {
public:
  explicit AgainCommands(const RunInfo& run);

  // A line for a POSIX shell that compares this material of this view alone; material null: the whole image. Empty
  // where the run does not say how.
  std::string of(const SceneResult& scene, const ViewResult& view, const MaterialResult* material) const;

private:
  const AgainCommand* find(const std::string& scene, std::string_view view) const;

  std::unordered_map<std::string, const AgainCommand*> m_commands; // by keyOf; the first of each
};

} // namespace parity::report
