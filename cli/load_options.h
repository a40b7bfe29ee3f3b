// The options of what is loaded of a scene's file, and how much of it at most. Only for the files that know CLI11.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/invocation.h"

namespace parity::cli {

// What CLI11 fills in; empty: not given.
struct RawLoadOptions {
  std::string subject = "scene", maxImage, maxMemory;
};

void addLoadOptions(CLI::App& app, scenes::LoadOptions& load, RawLoadOptions& raw);
// Those that a suite says itself: all but the limits.
const std::vector<std::string>& loadOptionNames();
// The pose and the choices, and the limits, each for itself: `info` has no subject.
void addChoiceOptions(CLI::App& app, scenes::LoadOptions& load);
void addLimitOptions(CLI::App& app, RawLoadOptions& raw);

// Throw CLI::ValidationError.
void settleLoad(CommonOptions& common, const RawLoadOptions& raw);
void settleLimits(scenes::LoadOptions& load, const RawLoadOptions& raw);

} // namespace parity::cli
