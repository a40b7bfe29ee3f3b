// The options of parity bake that no other subcommand has. Only for the files that know CLI11.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "cli/invocation.h"

namespace parity::cli {

// What CLI11 fills in.
struct RawBakeOptions {
  std::string error = "1%", astc = "4x4", localLights = "static", captures = "auto", density = "auto";
};

// `command` and `raw` must outlive the parsing.
void addBakeOptions(CLI::App& app, BakeCommand& command, RawBakeOptions& raw);

// Throws CLI::ValidationError, and others of CLI11.
BakeCommand settleBake(const BakeCommand& command, const RawBakeOptions& raw, const CLI::App& app);

} // namespace parity::cli
