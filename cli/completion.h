// Scripts that complete the command line in a shell: subcommands, options, values that are one of a few, built-in
// scenes and environments, files and folders.
#pragma once

#include <string>
#include <vector>

#include "cli/options/app_description.h"

namespace parity::cli {

inline const std::vector<std::string> kShells = {"bash", "zsh", "fish"};

// What stands for the paths that are called SCENE and ENVIRONMENT: names, and files of these kinds (without the dot).
struct CompletedPaths {
  std::vector<std::string> names, extensions;
};

struct CompletionInput {
  CommandText program;
  CompletedPaths scenes, environments;
};

// The script of a shell of kShells.
std::string completionScript(const std::string& shell, const CompletionInput& input);

} // namespace parity::cli
