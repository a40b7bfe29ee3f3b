// Draws casters of shadows: depth alone, with the alpha test where a material has one.
#pragma once

#include <memory>

#include "gpu/device/pipeline.h"
#include "gpu/surface/scene_buffers.h"

namespace parity::gpu {

class CasterPass {
public:
  // Uploads the textures whose alpha is tested. Both must outlive it.
  CasterPass(const Device& device, const SceneBuffers& scene);

  // Binds what all casters share. Targets, viewport and scissor are the caller's: D32, of which the greatest is kept.
  void begin(const vk::raii::CommandBuffer& commands) const;
  // worldToClip: in double, rounded together with the instance's own transform.
  void draw(const vk::raii::CommandBuffer& commands, const glm::dmat4& worldToClip, std::uint32_t instance) const;

private:
  const SceneBuffers& m_scene;
  std::vector<Binding> m_geometry;
  vk::raii::DescriptorSetLayout m_geometryLayout, m_textureLayout;
  vk::raii::PipelineLayout m_layout;
  vk::raii::Pipeline m_plain, m_masked{nullptr};
  DescriptorSets m_geometrySet;
  std::unique_ptr<DescriptorSets> m_textureSets;
};

} // namespace parity::gpu
