#include "gpu/spirv/spirv_cost.h"

#include <optional>
#include <string>

#include <glslang/SPIRV/spirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include "base/error.h"
#include "gpu/spirv/spirv_count.h"
#include "gpu/spirv/spirv_specialize.h"

namespace parity::gpu {

namespace {

using Words = std::vector<std::uint32_t>;

Words optimize(std::span<const std::uint32_t> words, bool validate, const auto& registerPasses) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  std::string message;
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
    if (level <= SPV_MSG_ERROR) message = text;
  });
  registerPasses(optimizer);
  spvtools::OptimizerOptions options;
  options.set_run_validator(validate);
  Words out;
  if (!optimizer.Run(words.data(), words.size(), &out, options)) refuseCost("spirv-opt: " + message);
  return out;
}

// Constants known, functions inlined, what cannot be reached gone.
Words specialize(Spirv spirv, std::span<const std::uint32_t> constants) {
  return optimize(specializeSpirv(spirv, constants), true, [](spvtools::Optimizer& optimizer) {
    optimizer
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass()) // those made of floating-point numbers
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPerformancePasses();
  });
}

// spirv-opt unrolls what is marked, and glslang marks nothing: so the short loops are.
Words unroll(const SpirvModule& module) {
  Words words = module.words();
  bool any = false;
  for (const SpirvBlock& block : module.blocks()) {
    if (block.merge == 0) continue;
    const std::optional<std::uint64_t> trips = module.tripsOf(block);
    if (!trips || *trips > kUnrolledTurns) continue;
    std::uint32_t& control = words[module.instructions()[block.loopMergeAt].word + 3];
    control = (control & ~std::uint32_t{spv::LoopControlDontUnrollMask}) | spv::LoopControlUnrollMask;
    any = true;
  }
  if (!any) return words;
  return optimize(words, false, [](spvtools::Optimizer& optimizer) {
    optimizer.RegisterPass(spvtools::CreateLoopUnrollPass(true)).RegisterPerformancePasses();
  });
}

} // namespace

std::uint64_t ShaderCost::fetches() const {
  std::uint64_t sum = 0;
  for (const Image& image : images) sum += image.fetches;
  return sum;
}

ShaderCost costOf(Spirv spirv, std::span<const std::uint32_t> constants) {
  const SpirvModule specialized(specialize(spirv, constants)), unrolled(unroll(specialized));
  return countOperations(unrolled);
}

} // namespace parity::gpu
