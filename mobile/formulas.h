// Environment BRDFs beside those of the mobile shader: each with a shader that brings its formula along.
#pragma once

#include <string>

#include "gpu/device/pipeline.h"
#include "mobile/options.h"

namespace parity::mobile {

// parity_formula (cmake/ParityShaders.cmake) makes the shaders from a file that defines
//   real2 ownEnvironmentBrdfAB(real3 SpecularColor, real Roughness, real NoV)
// A and B of SpecularColor A + B, of arguments in [0, 1]. Fully rough materials never ask for it.
struct Formula {
  std::string name; // as environmentBrdfNames() has it
  gpu::Spirv fp16, fp32;
};

// Before main: the table of knobs is made once.
EnvironmentBrdf addFormula(const Formula& formula);
// Null: one of the mobile shader's own.
const Formula* formulaOf(EnvironmentBrdf environmentBrdf);

} // namespace parity::mobile
