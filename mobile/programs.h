// The mobile path's programs: those that are built in, and what a preset folder makes of them.
#pragma once

#include "gpu/device/pipeline.h"
#include "mobile/options.h"
#include "paths/preset/preset_folder.h"

namespace parity::mobile {

struct ProgramKind {
  Precision precision = Precision::fp16;
  bool lobes = false; // for scenes with gpu::kFeatureLobes
  bool wide = false;  // the knobs are data; has the lobes
};

// Compiles a folder's at the first call, then throws what PresetFolder::program throws.
gpu::Spirv programOf(const Options& options, const ProgramKind& kind);

// The program of mobile/probe.h, compiled at every call.
std::vector<std::uint32_t> probeProgramOf(const Options& options, Precision precision);

// The shader's numbers of the enumerators.
std::uint32_t numberOf(EnvironmentBrdf environmentBrdf);
std::uint32_t numberOf(DirectLobe directLobe);

// What the path offers to preset folders: its presets, its knobs, and the functions of shading/mobile_preset.glsl.
const paths::PresetHost& presetHost();

// The options of a preset folder: those of its base, then its knobs, then its functions. `plain`: the rest, which no
// preset sets. Throws Error (failed).
Options optionsOfFolder(const std::string& text, const Options& plain);

} // namespace parity::mobile
