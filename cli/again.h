// "To see it again": the commands that compare one view of a run once more.
#pragma once

#include <string>
#include <vector>

#include "job/scene_request.h"
#include "report/report.h"

namespace CLI {
class App;
}

namespace parity::cli {

// The words of a parsed command line that another subcommand takes, too, and that decide what comes out: not which
// scenes, views and materials, not what is written, and where.
std::vector<std::string> keptWords(const CLI::App& parsed, const CLI::App& other);

// Where the scenes of a run are from: a suite's file, or else the command line with its environments.
struct SceneSource {
  std::string suite;
  std::vector<std::string> environments;
};

// `parity diff` for each view of these scenes.
std::vector<report::AgainCommand> againCommands(const std::vector<job::SceneRequest>& scenes, const SceneSource& source,
                                                const std::vector<std::string>& kept);

} // namespace parity::cli
