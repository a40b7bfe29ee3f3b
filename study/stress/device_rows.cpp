#include "study/stress/device_rows.h"

#include <array>
#include <limits>

#include "stress_shaders/baked_fp16.comp.h"
#include "stress_shaders/baked_fp32.comp.h"
#include "stress_shaders/base_pass_fp16.comp.h"
#include "stress_shaders/base_pass_fp32.comp.h"
#include "stress_shaders/functions_fp16.comp.h"
#include "stress_shaders/functions_fp32.comp.h"
#include "study/stress/shaders/function_ids.glsl"

namespace parity::stress {

namespace {

constexpr std::uint32_t kGroupSize = 64;
constexpr vk::ShaderStageFlags kStage = vk::ShaderStageFlagBits::eCompute;

} // namespace

gpu::Spirv functionShader(int id, bool half) {
  if (id < kFirstOfBasePass) return half ? gpu::Spirv(kFunctionsFp16Comp) : gpu::Spirv(kFunctionsFp32Comp);
  if (id < kFirstOfBaked) return half ? gpu::Spirv(kBasePassFp16Comp) : gpu::Spirv(kBasePassFp32Comp);
  return half ? gpu::Spirv(kBakedFp16Comp) : gpu::Spirv(kBakedFp32Comp);
}

DeviceRows::DeviceRows(const gpu::Device& device, gpu::Spirv shader, std::int32_t function) : m_device(device) {
  const std::array<gpu::Binding, 2> bindings = {gpu::BufferBinding{}, gpu::BufferBinding{}};
  m_setLayout = gpu::makeSetLayout(device, bindings, kStage);
  const std::array<vk::DescriptorSetLayout, 1> sets = {*m_setLayout};
  m_layout = gpu::makePipelineLayout(device, sets, sizeof(std::uint32_t), kStage);
  const std::array<std::uint32_t, 1> constants = {static_cast<std::uint32_t>(function)};
  m_pipeline = gpu::makeComputePipeline(device, m_layout, shader, constants);
  device.checkValidation(); // before a pipeline that the layer refused is used
}

std::vector<float> DeviceRows::run(std::span<const float> inputs, std::uint32_t rows,
                                   std::uint32_t outputStride) const {
  const std::size_t count = std::size_t{rows} * outputStride;
  const std::vector<float> unwritten(count, std::numeric_limits<float>::quiet_NaN());
  const gpu::Buffer in(m_device, inputs), out(m_device, std::span<const float>(unwritten));
  const std::vector<gpu::Binding> bindings = {gpu::storage(in), gpu::storage(out)};
  const gpu::DescriptorSets sets(m_device, m_setLayout, std::span{&bindings, 1});
  m_device.submit("stress", [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *m_pipeline);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *m_layout, 0, sets[0], nullptr);
    commands.pushConstants<std::uint32_t>(*m_layout, kStage, 0, rows);
    commands.dispatch((rows + kGroupSize - 1) / kGroupSize, 1, 1);
    gpu::fullBarrier(commands);
  });
  return out.downloadAs<float>(count);
}

} // namespace parity::stress
