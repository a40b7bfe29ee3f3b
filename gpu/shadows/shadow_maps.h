// Shadow maps on the device: drawn for a scene, read by whatever shades it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gpu/shadows/caster_pass.h"
#include "gpu/shadows/shadow_tiles.h"
#include "gpu/shadows/shadow_window.h"
#include "gpu/surface/surface.h"

namespace parity::gpu {

class ShadowMaps {
public:
  // Draws the maps of these lights' casters (planShadows), all into the layers of one image; alpha masks are tested as
  // in the pictures. Throws Error (exit 4) where they take more than the device or the options allow. Device and scene
  // must outlive it.
  ShadowMaps(const Device& device, const SceneBuffers& scene, const std::vector<scenes::Light>& lights,
             const ShadowOptions& options);

  // Of one of the constructor's lights; others have none.
  ShadowOfLight of(const scenes::Light& light) const;

  // Draws anew the maps of directional lights of which this surface sees but a small part
  // (gpu/shadows/shadow_window.h), or no longer does. Local lights' stay as they are. Blended layers, which follow the
  // opaque one that they lie over, take its maps where those hold them.
  void fitTo(const Surface& surface);

  std::uint32_t filter() const { return m_options.filter; }
  // The views as they are drawn now, and which of them each of the constructor's lights has.
  const std::vector<ShadowView>& drawn() const { return m_drawn; }
  // Maps that have been drawn, and instances drawn into them.
  std::size_t mapCount() const { return m_mapCount; }
  std::size_t drawCount() const { return m_drawCount; }
  // What the maps lack of what was asked for, in words; empty: nothing.
  std::string note() const;

  // Bindings of the shaders: the array image, and its GpuShadowView.
  vk::DescriptorImageInfo image() const;
  const Buffer& views() const { return m_views; }

private:
  void draw(const std::vector<std::size_t>& views, bool first);
  void drawView(const vk::raii::CommandBuffer& commands, std::size_t k, bool clears);

  const Device& m_device;
  ShadowOptions m_options;
  ShadowPlan m_plan;
  std::vector<ShadowView> m_drawn;     // of the plan, but through their windows
  std::vector<ShadowWindow> m_windows; // of each
  CasterPass m_pass;
  ShadowTiling m_tiling;
  std::size_t m_mapCount = 0, m_drawCount = 0;
  std::map<ShadowKey, ShadowOfLight> m_ofLight;
  DeviceImage m_image;
  vk::raii::Sampler m_sampler{nullptr};
  Buffer m_views;
};

} // namespace parity::gpu
