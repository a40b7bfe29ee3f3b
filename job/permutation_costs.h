// Which shaders a path ran, for the report, and what they cost.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "compare/permutation.h"
#include "gpu/shading_pass.h"
#include "job/context.h"

namespace parity::job {

// Of a pass that has shaded. Costs only where the settings ask for them: each takes some 0.1 s, and is kept in the
// cache. Throws Error (failed) as gpu::costOf does.
using CountSamplers = std::function<std::size_t(const gpu::Permutation&)>;
std::vector<compare::PermutationResult> describePermutations(Context& context, const std::string& path,
                                                             const gpu::ShadingPass& pass,
                                                             const CountSamplers& countSamplers);

} // namespace parity::job
