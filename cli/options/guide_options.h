// The subcommands about the command line itself: help, completion, man. Only for the files that know CLI11.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/invocation.h"

namespace parity::cli {

// What CLI11 fills in.
struct RawGuideOptions {
  std::vector<std::string> helpOf;
  std::string shell, manOf, manFolder;
};

// Behind all other subcommands, whose names they take. `raw` must outlive the parsing.
void addGuideOptions(CLI::App& app, RawGuideOptions& raw);

// After parsing, where one of them was given: what it prints or writes. Throws CLI::ValidationError.
GuideCommand settleGuide(const CLI::App& app, const RawGuideOptions& raw);

// "parity help X Y" as "parity X Y --help", which are the same.
std::vector<std::string> expandHelp(const std::vector<std::string>& arguments);

} // namespace parity::cli
