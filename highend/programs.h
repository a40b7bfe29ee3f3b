// The high-end path's programs: those that are built in, and what a preset folder makes of them.
#pragma once

#include <string>

#include "gpu/device/pipeline.h"
#include "highend/options.h"
#include "paths/preset/preset_folder.h"

namespace parity::highend {

// lobes: for scenes with gpu::kFeatureLobes. Compiles a folder's at the first call, then throws what
// PresetFolder::program throws.
gpu::Spirv programOf(const Options& options, bool lobes);

// What the path offers to preset folders: its knobs, and the functions of highend/shaders/preset.glsl.
const paths::PresetHost& presetHost();

// The options of a preset folder: the defaults, its knobs and its functions. Throws Error (failed).
Options optionsOfFolder(const std::string& text);

} // namespace parity::highend
