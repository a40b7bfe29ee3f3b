// Shadow maps on the device: drawn once for a scene, read by whatever shades it.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "gpu/pipeline.h"
#include "gpu/scene_buffers.h"
#include "gpu/shadow_views.h"

namespace parity::gpu {

class ShadowMaps {
public:
  // Draws the maps of these lights' casters (planShadows), all into the layers of one image; alpha masks are tested as
  // in the pictures. Throws Error (exit 4) where they take more than the device or the options allow.
  ShadowMaps(const Device& device, const SceneBuffers& scene, const std::vector<scenes::Light>& lights,
             const ShadowOptions& options);

  // Of one of the constructor's lights; others have none.
  ShadowOfLight of(const scenes::Light& light) const;

  std::uint32_t filter() const { return m_options.filter; }
  // Maps that were drawn, instances drawn into them, and lights of the constructor that have one.
  std::size_t mapCount() const { return m_mapCount; }
  std::size_t drawCount() const { return m_drawCount; }
  std::size_t lightCount() const { return m_lightCount; }
  // What the maps lack of what was asked for, in words; empty: nothing.
  const std::string& note() const { return m_note; }

  // Bindings of the shaders: the array image, and its GpuShadowView.
  vk::DescriptorImageInfo image() const;
  const Buffer& views() const { return m_views; }

private:
  ShadowOptions m_options;
  std::size_t m_mapCount = 0, m_drawCount = 0, m_lightCount = 0;
  std::string m_note;
  std::map<ShadowKey, ShadowOfLight> m_ofLight;
  DeviceImage m_image;
  vk::raii::Sampler m_sampler{nullptr};
  Buffer m_views;
};

} // namespace parity::gpu
