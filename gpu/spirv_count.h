// The count itself: a module as it stands, by the rules of gpu/spirv_cost.h.
#pragma once

#include "gpu/spirv_cost.h"
#include "gpu/spirv_module.h"

namespace parity::gpu {

// Throws Error (failed) for instructions that the count does not know, calls of functions among them.
ShaderCost countOperations(const SpirvModule& module);

} // namespace parity::gpu
