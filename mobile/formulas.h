// Presets beside the built-in ones, each with an environment BRDF of its own.
#pragma once

#include <vector>

#include "gpu/device/pipeline.h"
#include "mobile/options.h"

namespace parity::mobile {

// The mobile shader with the formula of a file that defines
//   real2 ownEnvironmentBrdfAB(real3 SpecularColor, real Roughness, real NoV)
// A and B of SpecularColor A + B, of arguments in [0, 1]; fully rough materials never ask for it. parity_formula
// (cmake/ParityShaders.cmake) makes all shaders from the file; those with lobes are of scenes with kFeatureLobes.
struct Formula {
  gpu::Spirv fp16, fp32, lobesFp16, lobesFp32;
};

// options: those of the preset, with its name; the formula takes that name and the place of options.environmentBrdf.
// Before main: the table of knobs is made once. Returns true. Two presets of one name are a std::logic_error at the
// first use of any.
bool addPreset(Options options, const Formula& formula);
// In the order in which they were added. The environment BRDF of the first is EnvironmentBrdf::refit + 1.
const std::vector<Options>& addedPresets();
// Null: one of the mobile shader's own.
const Formula* formulaOf(EnvironmentBrdf environmentBrdf);

} // namespace parity::mobile
