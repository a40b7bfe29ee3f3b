// The count itself: a module as it stands, by the rules of gpu/spirv/spirv_cost.h.
#pragma once

#include <string>

#include "gpu/spirv/spirv_cost.h"
#include "gpu/spirv/spirv_module.h"

namespace parity::gpu {

// Throws Error (failed): why there is no cost.
[[noreturn]] void refuseCost(const std::string& reason);

// Throws Error (failed) for instructions that the count does not know, calls of functions among them.
ShaderCost countOperations(const SpirvModule& module);

} // namespace parity::gpu
