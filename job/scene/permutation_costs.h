// Which shaders a path ran, for the report, and what they cost.
#pragma once

#include <string>
#include <vector>

#include "job/context.h"
#include "report/permutation.h"

namespace parity::job {

// Of a renderer that has shaded. Costs only where the settings ask for them: each takes some 0.1 s, and is kept in the
// cache. Throws Error (failed) as gpu::costOf does.
std::vector<report::PermutationResult> describePermutations(Context& context, const std::string& path,
                                                            const paths::Renderer& renderer);

} // namespace parity::job
