// A compute shader of a test, run once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/device/pipeline.h"

namespace parity::gpu {

// The module as it is: nothing rewrites its words. bindings: of set 0. The caller reads the buffers then.
inline void runWords(const Device& device, const std::vector<std::uint32_t>& words,
                     const std::vector<Binding>& bindings, std::uint32_t groups) {
  constexpr auto compute = vk::ShaderStageFlagBits::eCompute;
  const vk::raii::DescriptorSetLayout setLayout = makeSetLayout(device, bindings, compute);
  const vk::raii::PipelineLayout layout = makePipelineLayout(device, std::array{*setLayout}, 0, compute);
  const DescriptorSets sets(device, setLayout, std::span{&bindings, 1});
  const vk::raii::ShaderModule module(device.handle(), vk::ShaderModuleCreateInfo({}, words));
  const vk::PipelineShaderStageCreateInfo stage({}, compute, *module, "main");
  const vk::raii::Pipeline pipeline(device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout));
  device.submit("test", [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, sets[0], nullptr);
    commands.dispatch(groups, 1, 1);
    fullBarrier(commands);
  });
}

} // namespace parity::gpu
