// The options of the scene's light as a whole: scales of its parts, and fog. Only for the files that know CLI11.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/invocation.h"

namespace parity::cli {

// What CLI11 fills in; an empty text: not given.
struct RawLightOptions {
  std::string skyLightColor, indirectColorScale, falloff = "khr", fog, fogColor;
  scenes::LightScales scales; // but what is text
  scenes::Fog fogBesides;     // likewise
};

void addLightOptions(CLI::App& app, RawLightOptions& raw);
// Their names: a suite says all of it itself.
const std::vector<std::string>& lightOptionNames();

// Throws CLI::ValidationError.
void settleLight(CommonOptions& common, const RawLightOptions& raw);

} // namespace parity::cli
