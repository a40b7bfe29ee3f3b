#include "highend/light_culling.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "highend_shaders/cull_lights.comp.h"

namespace parity::highend {

namespace {

constexpr auto kCompute = vk::ShaderStageFlagBits::eCompute;
constexpr std::size_t kCounts = 4; // words before pathData

constexpr std::uint32_t kLargeGroup = gpu::kRegionSide * gpu::kRegionSide; // entries
constexpr std::size_t kWords = 4;                                          // of a group

// First entry, number of entries and larger group of each group of a bin, which has at most `size` entries.
std::vector<std::uint32_t> listGroups(const gpu::Surface& surface, std::uint32_t size) {
  static_assert(kLargeGroup % gpu::kGroupSize == 0);
  std::vector<std::uint32_t> groups;
  std::uint32_t larger = 0; // of the bins before
  for (const gpu::Bin& bin : surface.bins) {
    for (std::uint32_t first = 0; first < bin.count; first += size)
      groups.insert(groups.end(),
                    {bin.first + first, std::min(bin.count - first, size), larger + first / kLargeGroup, 0});
    larger += (bin.count + kLargeGroup - 1) / kLargeGroup;
  }
  return groups;
}

} // namespace

LightCulling::LightCulling(const gpu::Device& device, const std::vector<gpu::GpuLight>& lights,
                           std::uint32_t firstBounded)
    : m_device(device), m_firstBounded(firstBounded),
      m_boundedCount(static_cast<std::uint32_t>(lights.size()) - firstBounded),
      m_lights(device, std::span<const gpu::GpuLight>(lights)) {}

struct LightCulling::Run {
  const gpu::Surface& surface;
  const gpu::Buffer& groups;
  std::uint32_t groupCount = 0;
  const gpu::Buffer& lists; // written where `writes`
  const gpu::Buffer* larger = nullptr;
  const gpu::Buffer& cursors;
  bool writes = false;
};

void LightCulling::run(const Run& run) const {
  const std::vector<gpu::Binding> bindings = {gpu::storage(run.surface.position),
                                              gpu::storage(m_lights),
                                              gpu::storage(run.groups),
                                              gpu::storage(run.lists),
                                              gpu::storage(run.larger ? *run.larger : m_lights),
                                              gpu::storage(run.cursors)};
  if (!*m_setLayout) {
    m_setLayout = gpu::makeSetLayout(m_device, bindings, kCompute);
    m_layout = gpu::makePipelineLayout(m_device, std::array{*m_setLayout}, sizeof(std::uint32_t), kCompute);
    for (const std::uint32_t refines : {0u, 1u})
      for (const std::uint32_t writes : {0u, 1u})
        m_pipelines.push_back(
            gpu::makeComputePipeline(m_device, m_layout, kCullLightsComp, std::array{writes, refines}));
  }
  const gpu::DescriptorSets set(m_device, m_setLayout, std::span(&bindings, 1));
  m_device.submit("cull lights", [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *m_pipelines[(run.writes ? 1 : 0) + (run.larger ? 2 : 0)]);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *m_layout, 0, set[0], {});
    const std::uint32_t blocks = (run.groupCount + gpu::kGroupSize - 1) / gpu::kGroupSize;
    for (std::uint32_t first = 0; first < m_boundedCount; first += gpu::kMaxCandidates) {
      commands.pushConstants<std::uint32_t>(*m_layout, kCompute, 0, first);
      commands.dispatch(std::min(blocks, gpu::kMaxGroupsInRow),
                        (blocks + gpu::kMaxGroupsInRow - 1) / gpu::kMaxGroupsInRow, 1);
      gpu::fullBarrier(commands);
    }
  });
}

gpu::Buffer LightCulling::makeLists(const gpu::Surface& surface, const std::vector<std::uint32_t>& groups,
                                    const gpu::Buffer* larger, const std::array<std::uint32_t, 4>& counts) const {
  const auto groupCount = static_cast<std::uint32_t>(groups.size() / kWords);
  std::vector<std::uint32_t> input = {groupCount, m_firstBounded, m_boundedCount, 0};
  input.insert(input.end(), groups.begin(), groups.end());
  const gpu::Buffer groupBuffer(m_device, std::span<const std::uint32_t>(input)), nowhere(m_device, 0);
  std::vector<std::uint32_t> lengths(groupCount, 0), begins;
  const gpu::Buffer cursors(m_device, std::span<const std::uint32_t>(lengths));
  if (groupCount > 0) run({surface, groupBuffer, groupCount, nowhere, larger, cursors, false});
  cursors.download(std::as_writable_bytes(std::span{lengths}));

  std::vector<std::uint32_t> data(counts.begin(), counts.end());
  data[1] -= m_boundedCount;
  data.push_back(1);
  std::size_t end = groupCount + 2; // in pathData: behind the 1 and the begins of all lists and of what follows them
  const std::size_t limit = m_device.properties().limits.maxStorageBufferRange;
  for (std::uint32_t g = 0; g <= groupCount; ++g) {
    begins.push_back(static_cast<std::uint32_t>(end));
    end += g < groupCount ? lengths[g] : 0;
    if ((kCounts + end) * sizeof(std::uint32_t) > limit)
      throw base::Error(
          base::ExitCode::failed, m_device.report().name, fmt::format("{} local lights", m_boundedCount),
          fmt::format("their lists need more than {} MiB, the most that the device can bind", limit >> 20));
    if (larger && g < groupCount && lengths[g] + data[1] > gpu::kMaxLightsOfAPixel)
      throw base::Error(base::ExitCode::failed, m_device.report().name, fmt::format("{} local lights", m_boundedCount),
                        fmt::format("{} of them reach the same pixels, expected at most {}; give lights a range",
                                    lengths[g] + data[1], gpu::kMaxLightsOfAPixel));
  }
  data.insert(data.end(), begins.begin(), begins.end());
  gpu::Buffer lists(m_device, (kCounts + end) * sizeof(std::uint32_t));
  lists.upload(std::as_bytes(std::span{data}));
  begins.pop_back();
  cursors.upload(std::as_bytes(std::span{begins}));
  if (groupCount > 0) run({surface, groupBuffer, groupCount, lists, larger, cursors, true});
  return lists;
}

gpu::Buffer LightCulling::listsFor(const gpu::Surface& surface, const std::array<std::uint32_t, 4>& counts) const {
  const std::vector<std::uint32_t> groups = listGroups(surface, gpu::kGroupSize);
  m_listCount += groups.size() / kWords;
  const gpu::Buffer large = makeLists(surface, listGroups(surface, kLargeGroup), nullptr, counts);
  return makeLists(surface, groups, &large, counts);
}

} // namespace parity::highend
