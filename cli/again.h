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

// `parity diff` for each view of these scenes. suite: the file that they are from; empty: each is a scene of its own.
std::vector<report::AgainCommand> againCommands(const std::vector<job::SceneRequest>& scenes, const std::string& suite,
                                                const std::vector<std::string>& kept);

} // namespace parity::cli
