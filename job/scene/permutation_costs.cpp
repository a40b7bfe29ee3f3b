#include "job/scene/permutation_costs.h"

#include <cstring>

#include "base/hash.h"
#include "base/parallel.h"
#include "gpu/spirv/spirv_cost.h"

namespace parity::job {

report::PermutationCost costOf(const Context& context, gpu::Spirv spirv, const std::vector<std::uint32_t>& constants) {
  static_assert(std::is_trivially_copyable_v<report::PermutationCost>);
  const std::string key = "costs-" + base::Hasher()
                                         .add(context.buildId())
                                         .add(std::as_bytes(spirv))
                                         .addValue(constants.size())
                                         .add(std::as_bytes(std::span{constants}))
                                         .hex();
  report::PermutationCost cost;
  if (const auto cached = context.cache().find(key); cached && cached->size() == sizeof cost) {
    std::memcpy(&cost, cached->data(), sizeof cost);
    return cost;
  }
  const gpu::ShaderCost counted = gpu::costOf(spirv, constants);
  cost = {counted.fp32, counted.fp16, counted.integer, counted.fetches(), counted.openLoops};
  context.cache().store(key, std::as_bytes(std::span{&cost, 1}));
  return cost;
}

std::vector<report::PermutationResult> describePermutations(Context& context, const std::string& path,
                                                            const paths::Renderer& renderer) {
  const base::Stopwatch watch(&context.timings(), "shader costs");
  const gpu::ShadingPass& pass = renderer.pass();
  const std::vector<gpu::CompiledPermutation>& compiled = pass.compiled();
  std::vector<report::PermutationResult> results(compiled.size());
  base::parallelFor(compiled.size(), 1, [&](std::size_t i, std::size_t) {
    const gpu::Permutation& permutation = compiled[i].permutation;
    results[i] = {path,
                  gpu::describeTextures(permutation.textures),
                  gpu::describeFeatures(permutation),
                  compiled[i].entries,
                  renderer.countSamplers(permutation),
                  std::nullopt};
    if (context.settings().costs) results[i].cost = costOf(context, pass.spirv(), compiled[i].constantsWithoutTerms());
  });
  return results;
}

} // namespace parity::job
