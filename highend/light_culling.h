// Which local lights reach which part of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gpu/device/pipeline.h"
#include "gpu/surface/surface.h"

namespace parity::highend {

// Lists for each group of gpu::kGroupSize entries of a bin, which lie close together (gpu::orderByBlocks), the local
// lights whose range and cone touch the box about the entries (the cone against a sphere about it: Wronski 2017, "Cull
// that cone!"). What is left out would have added exactly nothing. Memory alone limits the number of lights.
class LightCulling {
public:
  // lights: those of the path's shader. firstBounded: those before it reach everything, or are directional.
  LightCulling(const gpu::Device& device, const std::vector<gpu::GpuLight>& lights, std::uint32_t firstBounded);

  // Binding 4 of the path's shader (gpu/shaders/path.glsl): the counts, that of local lights without those listed; 1;
  // for each group where its list begins, and where the last one ends; the lists, indices into the lights in ascending
  // order. counts: of the scene. Throws Error (exit 4) where the device cannot bind so much, and where more than
  // gpu::kMaxLightsOfAPixel may reach a pixel.
  gpu::Buffer listsFor(const gpu::Surface& surface, const std::array<std::uint32_t, 4>& counts) const;

  // How many lists it has made.
  std::uint64_t listCount() const { return m_listCount; }

private:
  // One size of groups: words of Groups in the shader, behind their head; larger: the lists of the larger groups, null
  // where all lights are to be asked.
  gpu::Buffer makeLists(const gpu::Surface& surface, const std::vector<std::uint32_t>& groups,
                        const gpu::Buffer* larger, const std::array<std::uint32_t, 4>& counts) const;
  struct Run; // of the shader
  void run(const Run& run) const;

  const gpu::Device& m_device;
  std::uint32_t m_firstBounded, m_boundedCount;
  gpu::Buffer m_lights;
  mutable std::uint64_t m_listCount = 0;
  mutable vk::raii::DescriptorSetLayout m_setLayout{nullptr}; // made with the first surface
  mutable vk::raii::PipelineLayout m_layout{nullptr};
  mutable std::vector<vk::raii::Pipeline> m_pipelines; // writes + 2 refines
};

} // namespace parity::highend
