// Which shaders a path ran, for the report, and what they cost.
#pragma once

#include <string>
#include <vector>

#include "job/context.h"
#include "report/permutation.h"

namespace parity::job {

// What a shader with these specialization constants costs. Some 0.1 s, and kept in the cache. Throws Error (failed) as
// gpu::costOf does. Thread-safe.
report::PermutationCost costOf(const Context& context, gpu::Spirv spirv, const std::vector<std::uint32_t>& constants);

// Of a renderer that has shaded. Costs only where the settings ask for them: each takes some 0.1 s, and is kept in the
// cache. Throws Error (failed) as gpu::costOf does.
std::vector<report::PermutationResult> describePermutations(Context& context, const std::string& path,
                                                            const paths::Renderer& renderer);

} // namespace parity::job
