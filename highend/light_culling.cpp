#include "highend/light_culling.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "highend_shaders/cull_lights.comp.h"

namespace parity::highend {

namespace {

constexpr auto kCompute = vk::ShaderStageFlagBits::eCompute;
constexpr std::size_t kCounts = 4; // words before pathData

// The head that the shader wants, then first entry and number of entries of each group.
std::vector<std::uint32_t> listGroups(const gpu::Surface& surface, std::uint32_t firstLight, std::uint32_t lightCount) {
  std::vector<std::uint32_t> groups(4);
  for (const gpu::Bin& bin : surface.bins)
    for (std::uint32_t first = 0; first < bin.count; first += gpu::kGroupSize)
      groups.insert(groups.end(), {bin.first + first, std::min(bin.count - first, gpu::kGroupSize)});
  groups[0] = static_cast<std::uint32_t>((groups.size() - 4) / 2);
  groups[1] = firstLight;
  groups[2] = lightCount;
  return groups;
}

} // namespace

LightCulling::LightCulling(const gpu::Device& device, const std::vector<gpu::GpuLight>& lights,
                           std::uint32_t firstBounded)
    : m_device(device), m_firstBounded(firstBounded),
      m_boundedCount(static_cast<std::uint32_t>(lights.size()) - firstBounded),
      m_lights(device, std::span<const gpu::GpuLight>(lights)) {}

void LightCulling::run(const gpu::Surface& surface, const gpu::Buffer& groups, std::uint32_t groupCount,
                       const gpu::Buffer& lists, bool writes) const {
  const std::vector<gpu::Binding> bindings = {gpu::storage(surface.position), gpu::storage(m_lights),
                                              gpu::storage(groups), gpu::storage(lists)};
  if (!*m_setLayout) {
    m_setLayout = gpu::makeSetLayout(m_device, bindings, kCompute);
    m_layout = gpu::makePipelineLayout(m_device, std::array{*m_setLayout}, 0, kCompute);
    m_count = gpu::makeComputePipeline(m_device, m_layout, kCullLightsComp, std::array{0u});
    m_write = gpu::makeComputePipeline(m_device, m_layout, kCullLightsComp, std::array{1u});
  }
  const gpu::DescriptorSets set(m_device, m_setLayout, std::span(&bindings, 1));
  m_device.submit("cull lights", [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, writes ? *m_write : *m_count);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *m_layout, 0, set[0], {});
    const std::uint32_t blocks = (groupCount + gpu::kGroupSize - 1) / gpu::kGroupSize;
    commands.dispatch(std::min(blocks, gpu::kMaxGroupsInRow),
                      (blocks + gpu::kMaxGroupsInRow - 1) / gpu::kMaxGroupsInRow, 1);
    gpu::fullBarrier(commands);
  });
}

gpu::Buffer LightCulling::listsFor(const gpu::Surface& surface, const std::array<std::uint32_t, 4>& counts) const {
  const std::vector<std::uint32_t> groups = listGroups(surface, m_firstBounded, m_boundedCount);
  const std::uint32_t groupCount = groups[0];
  m_listCount += groupCount;
  std::vector<std::uint32_t> data(kCounts + 2 + groupCount);
  std::copy(counts.begin(), counts.end(), data.begin());
  data[1] -= m_boundedCount;
  data[kCounts] = 1;
  std::size_t end = data.size() - kCounts; // in pathData
  const auto bytes = [&] { return (kCounts + end) * sizeof(std::uint32_t); };
  gpu::Buffer groupBuffer(m_device, std::span<const std::uint32_t>(groups));
  if (groupCount > 0) {
    const gpu::Buffer counted(m_device, std::span<const std::uint32_t>(data));
    run(surface, groupBuffer, groupCount, counted, false);
    counted.download(std::as_writable_bytes(std::span{data}));
  }
  for (std::size_t g = kCounts + 1; g < data.size(); ++g) {
    const std::uint32_t count = g + 1 < data.size() ? data[g] : 0;
    data[g] = static_cast<std::uint32_t>(end);
    end += count;
    if (const std::size_t limit = m_device.properties().limits.maxStorageBufferRange; bytes() > limit)
      throw base::Error(base::ExitCode::failed, m_device.report().name, fmt::format("{} local lights", m_boundedCount),
                        fmt::format("their lists take more than the {} MiB that the device binds", limit >> 20));
  }
  gpu::Buffer lists(m_device, bytes());
  lists.upload(std::as_bytes(std::span{data}));
  if (groupCount > 0) run(surface, groupBuffer, groupCount, lists, true);
  return lists;
}

} // namespace parity::highend
