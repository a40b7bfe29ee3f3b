// Frames and pixel lists from shaded surfaces: tiles put together, samples averaged, the blended layer laid on top.
#pragma once

#include <vector>

#include "base/frame.h"
#include "gpu/shading_pass.h"

namespace parity::gpu {

// Gathers one path's picture. background: linear RGB, where no material is seen.
class FrameBuilder {
public:
  FrameBuilder(std::uint32_t width, std::uint32_t height, int samples, bool terms, const glm::vec3& background);

  // One (tile, sample): the opaque surface with its shading, then the blended one where the scene has any (else null).
  void add(const Surface& opaque, const ShadedSurface& opaqueShaded, const Surface* blended,
           const ShadedSurface* blendedShaded, const Tile& tile);
  base::Frame take() { return std::move(m_frame); }

private:
  float m_weight;
  glm::vec3 m_background;
  base::Frame m_frame;
};

// Gathers which pixels show which material, with weights: the share of samples, times the opacity of a blended layer,
// times what it lets through of the surface behind it.
class CoverageBuilder {
public:
  CoverageBuilder(const SceneBuffers& scene, std::uint32_t width, std::uint32_t height, int samples);
  void add(const Surface& opaque, const Surface* blended, const ShadedSurface* blendedShaded);
  // One list per material, in the scene's order; a material that no pixel shows has an empty one. Weights are left out
  // where all are 1.
  std::vector<base::PixelList> take();

private:
  const SceneBuffers& m_scene;
  std::uint32_t m_width, m_height;
  float m_weight;
  struct Hit {
    std::uint32_t material, pixel;
    float weight;
  };
  std::vector<Hit> m_hits;
};

} // namespace parity::gpu
