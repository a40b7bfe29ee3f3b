// The options of the paths: shadows, the mobile path's presets and knobs, the high-end path's model. Only for the files
// that know CLI11.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "job/settings.h"

namespace parity::cli {

// What CLI11 fills in.
struct RawPathOptions {
  std::string precision = "fp16", specularAa = "off", mobileTarget, mobileTextures;
  std::string mobilePreset = "ue4-2020", capture, captureScale, directLobe; // the last three: empty is the preset's
  std::string skyForm;
  mobile::Mixing mixing;
  std::string geometryTerm, fresnel, diffuse, compensation, offSpecular; // of the high-end path and the reference
  std::uint32_t shadowMapSize = gpu::ShadowOptions().mapSize, shadowFilter = gpu::ShadowOptions().filter;
  bool shadows = false;
  mobile::Options mobileShadows; // of which the shadows' knobs are read
};

// defaults: what options begin as where they take a name.
void addPathOptions(CLI::App& app, const job::Settings& defaults, RawPathOptions& raw);

// Throws CLI::ValidationError.
void settlePaths(job::Settings& settings, const RawPathOptions& raw);

} // namespace parity::cli
