#include "gpu/device/numerics.h"

#include <array>
#include <span>

#include "gpu/device/pipeline.h"
#include "gpu/shaders/numerics_interface.h"
#include "gpu_shaders/numerics_fp16.comp.h"
#include "gpu_shaders/numerics_fp32.comp.h"

namespace parity::gpu {

namespace {

constexpr vk::ShaderStageFlags kStage = vk::ShaderStageFlagBits::eCompute;
constexpr std::uint32_t kNumericsGroup = 64, kSide = 16;

// Texels without a pattern, in four mips that are not averages of one another: each filter weight shows.
DeviceImage makeImage(const Device& device) {
  std::vector<std::vector<std::byte>> mips;
  std::vector<std::span<const std::byte>> spans;
  std::uint32_t state = 1;
  for (std::uint32_t side = kSide; side > 1; side /= 2) {
    std::vector<std::byte>& mip = mips.emplace_back(std::size_t{4} * side * side);
    for (std::byte& value : mip) value = static_cast<std::byte>((state = state * 1664525u + 1013904223u) >> 24);
  }
  for (const std::vector<std::byte>& mip : mips) spans.emplace_back(mip);
  return {device, {.width = kSide, .height = kSide, .mips = static_cast<std::uint32_t>(mips.size())}, spans};
}

vk::raii::Sampler makeTrilinear(const Device& device) {
  vk::SamplerCreateInfo info({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
  info.maxLod = VK_LOD_CLAMP_NONE;
  return {device.handle(), info};
}

} // namespace

std::vector<std::uint32_t> numericsOf(const Device& device) {
  constexpr std::size_t kWords = std::size_t{kNumericsRows} * kNumericsWords;
  const DeviceImage image = makeImage(device);
  const vk::raii::Sampler sampler = makeTrilinear(device);
  const Buffer rows(device, kWords * sizeof(std::uint32_t));
  const std::vector<Binding> bindings = {storage(rows),
                                         vk::DescriptorImageInfo(*sampler, image.view(), kReadOnlyLayout)};
  const vk::raii::DescriptorSetLayout setLayout = makeSetLayout(device, bindings, kStage);
  const std::array<vk::DescriptorSetLayout, 1> sets = {*setLayout};
  const vk::raii::PipelineLayout layout = makePipelineLayout(device, sets, 0, kStage);
  const Spirv shader = device.report().float16 ? Spirv(kNumericsFp16Comp) : Spirv(kNumericsFp32Comp);
  const vk::raii::Pipeline pipeline = makeComputePipeline(device, layout, shader, {});
  device.checkValidation();
  const DescriptorSets bound(device, setLayout, std::span{&bindings, 1});
  device.submit("numerics", [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout, 0, bound[0], nullptr);
    commands.dispatch(kNumericsRows / kNumericsGroup, 1, 1);
    fullBarrier(commands);
  });
  return rows.downloadAs<std::uint32_t>(kWords);
}

} // namespace parity::gpu
