#include "mobile/probe.h"

#include <array>
#include <bit>

#include "gpu/device/buffer.h"
#include "gpu/device/pipeline.h"
#include "mobile/programs.h"
#include "mobile/renderer.h"

namespace parity::mobile {

namespace {

constexpr vk::ShaderStageFlags kStage = vk::ShaderStageFlagBits::eCompute;
constexpr std::uint32_t kGroup = 64; // local_size_x of path.glsl
constexpr std::size_t kEnvironmentBrdfAt = 8, kSunAt = 9,
                      kRoughnessFloorAt = 13; // specialization constants of mobile.glsl

} // namespace

std::vector<glm::vec4> probe(const gpu::Device& device, const Options& options, std::span<const ProbeCall> calls) {
  const std::vector<std::uint32_t> words = probeProgramOf(options, precisionOn(device.report(), options));
  std::vector<std::uint32_t> constants(kRoughnessFloorAt + 1, 0);
  constants[kEnvironmentBrdfAt] = numberOf(options.environmentBrdf);
  constants[kSunAt] = numberOf(options.directLobe);
  constants[kRoughnessFloorAt] = std::bit_cast<std::uint32_t>(options.roughnessFloor);

  const gpu::Buffer input(device, calls.size_bytes()), output(device, calls.size() * sizeof(glm::vec4));
  input.upload(std::as_bytes(calls));
  const std::vector<gpu::Binding> bindings = {gpu::storage(input), gpu::storage(output)};
  const vk::raii::DescriptorSetLayout none = gpu::makeSetLayout(device, {}, kStage),
                                      probed = gpu::makeSetLayout(device, bindings, kStage);
  const std::array<vk::DescriptorSetLayout, 3> sets = {*none, *none, *probed};
  const vk::raii::PipelineLayout layout = gpu::makePipelineLayout(device, sets, 16, kStage);
  const vk::raii::Pipeline pipeline = gpu::makeComputePipeline(device, layout, words, constants);
  device.checkValidation();
  const gpu::DescriptorSets bound(device, probed, std::span{&bindings, 1});
  device.submit("probe", [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 2, bound[0], nullptr);
    commands.dispatch((static_cast<std::uint32_t>(calls.size()) + kGroup - 1) / kGroup, 1, 1);
    gpu::fullBarrier(commands);
  });
  return output.downloadAs<glm::vec4>(calls.size());
}

} // namespace parity::mobile
