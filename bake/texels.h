// The surface behind the texels of an atlas: a supersampled raster of its pages.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas.h"

namespace parity::bake {

struct SurfacePoint {
  glm::vec3 position{0.f};  // world
  glm::vec3 normal{0.f};    // interpolated, unit
  glm::vec3 geometric{0.f}; // of the triangle, unit, on the side of its front
  std::uint32_t instance = 0;
};

// A texel that some triangle covers.
struct Texel {
  std::uint32_t page = 0, instance = 0;
  std::uint16_t x = 0, y = 0;
};

class TexelGrid {
public:
  // factor: sub-texels along a texel's side. Both must outlive it.
  TexelGrid(const scenes::Scene& scene, const Atlas& atlas, int factor);

  int factor() const { return m_factor; }
  // Page by page, row by row.
  const std::vector<Texel>& texels() const { return m_texels; }
  // The surface at a sub-texel's middle, x and y in [0, pageSide * factor); nothing where there is none. A triangle
  // that holds no sub-texel's middle still has the one that its own middle lies in, unless another triangle has it.
  std::optional<SurfacePoint> at(std::uint32_t page, int x, int y) const;
  std::size_t bytes() const; // of memory held

private:
  const scenes::Scene& m_scene;
  const Atlas& m_atlas;
  int m_factor;
  std::vector<Texel> m_texels;
  std::vector<std::vector<std::uint32_t>> m_triangles; // of each page's sub-texels: a number over all instances
  std::vector<std::uint32_t> m_firstTriangle;          // of each instance in that numbering
};

} // namespace parity::bake
