#include "gpu/device/pipeline.h"

#include <algorithm>

#include "gpu/spirv/spirv_half.h"
#include "gpu/spirv/spirv_half_compare.h"
#include "gpu/spirv/spirv_pairs.h"
#include "gpu/spirv/spirv_specialize.h"

namespace parity::gpu {

namespace {

vk::DescriptorType typeOf(const Binding& binding) {
  if (const auto* buffer = std::get_if<BufferBinding>(&binding))
    return buffer->uniform ? vk::DescriptorType::eUniformBuffer : vk::DescriptorType::eStorageBuffer;
  return vk::DescriptorType::eCombinedImageSampler;
}

} // namespace

vk::raii::DescriptorSetLayout makeSetLayout(const Device& device, std::span<const Binding> bindings,
                                            vk::ShaderStageFlags stages) {
  std::vector<vk::DescriptorSetLayoutBinding> layout;
  for (const Binding& binding : bindings)
    layout.emplace_back(static_cast<std::uint32_t>(layout.size()), typeOf(binding), 1, stages);
  return vk::raii::DescriptorSetLayout(device.handle(), vk::DescriptorSetLayoutCreateInfo({}, layout));
}

DescriptorSets::DescriptorSets(const Device& device, const vk::raii::DescriptorSetLayout& layout,
                               std::span<const std::vector<Binding>> contents) {
  if (contents.empty()) return;
  std::vector<vk::DescriptorPoolSize> sizes;
  for (const std::vector<Binding>& set : contents)
    for (const Binding& binding : set) sizes.emplace_back(typeOf(binding), 1);
  m_pool = vk::raii::DescriptorPool(
      device.handle(), vk::DescriptorPoolCreateInfo({}, static_cast<std::uint32_t>(contents.size()), sizes));
  const std::vector<vk::DescriptorSetLayout> layouts(contents.size(), *layout);
  m_sets =
      (*device.handle())
          .allocateDescriptorSets(vk::DescriptorSetAllocateInfo(*m_pool, layouts), *device.handle().getDispatcher());
  std::vector<vk::WriteDescriptorSet> writes;
  for (std::size_t set = 0; set < contents.size(); ++set)
    for (std::uint32_t i = 0; i < contents[set].size(); ++i) {
      const Binding& binding = contents[set][i];
      vk::WriteDescriptorSet write(m_sets[set], i, 0, 1, typeOf(binding));
      if (const auto* buffer = std::get_if<BufferBinding>(&binding))
        write.setBufferInfo(buffer->info);
      else
        write.setImageInfo(std::get<vk::DescriptorImageInfo>(binding));
      writes.push_back(write);
    }
  device.handle().updateDescriptorSets(writes, {});
}

vk::raii::PipelineLayout makePipelineLayout(const Device& device, std::span<const vk::DescriptorSetLayout> sets,
                                            std::uint32_t pushBytes, vk::ShaderStageFlags stages) {
  const vk::PushConstantRange push(stages, 0, pushBytes);
  vk::PipelineLayoutCreateInfo info;
  info.setSetLayouts(sets);
  if (pushBytes > 0) info.setPushConstantRanges(push);
  return vk::raii::PipelineLayout(device.handle(), info);
}

vk::raii::Pipeline makeComputePipeline(const Device& device, const vk::raii::PipelineLayout& layout, Spirv spirv,
                                       std::span<const std::uint32_t> constants) {
  std::vector<std::uint32_t> words = specializeSpirv(spirv, constants);
  if (device.properties().deviceType == vk::PhysicalDeviceType::eCpu)
    words = compareHalvesWidened(convertHalvesByBits(std::move(words)));
  if (device.accessesByPairs()) words = accessBuffersByPairs(std::move(words));
  const vk::raii::ShaderModule module(device.handle(), vk::ShaderModuleCreateInfo({}, words));
  const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main");
  return vk::raii::Pipeline(device.handle(), nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout));
}

vk::Pipeline PipelineStore::find(Spirv spirv, std::span<const std::uint32_t> constants) const {
  const auto found = std::ranges::find_if(m_entries, [&](const Entry& each) {
    return each.spirv.data() == spirv.data() && std::ranges::equal(each.constants, constants);
  });
  return found == m_entries.end() ? vk::Pipeline() : *found->pipeline;
}

vk::Pipeline PipelineStore::add(Spirv spirv, std::span<const std::uint32_t> constants, vk::raii::Pipeline pipeline) {
  m_entries.push_back({spirv, {constants.begin(), constants.end()}, std::move(pipeline)});
  return *m_entries.back().pipeline;
}

std::set<PipelineStore::Key> PipelineStore::keys() const {
  std::set<Key> keys;
  for (const Entry& entry : m_entries) keys.emplace(Shader{entry.spirv}, entry.constants);
  return keys;
}

} // namespace parity::gpu
