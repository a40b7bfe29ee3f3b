// The surface behind the texels of an atlas: a supersampled raster of its pages.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas/atlas.h"

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
  // factor: sub-texels along a texel's side, 1 to 16. Both must outlive it. Throws base::Error (exit 4) for more than
  // 2^31 triangles over all instances.
  TexelGrid(const scenes::Scene& scene, const Atlas& atlas, int factor);

  int factor() const { return m_factor; }
  // Page by page, row by row.
  const std::vector<Texel>& texels() const { return m_texels; }
  // The surface at a sub-texel's middle, x and y in [0, pageSide * factor); nothing where there is none. A triangle
  // that holds no sub-texel's middle still has the one that its own middle lies in, unless another triangle has it; and
  // a texel that triangles only touch has one sub-texel of them: whatever texel a point of a chart lies in is its own,
  // and dilation by one fills what a bilinear read there needs beside it. Of several triangles that hold a middle (on
  // their common edge) the first has it.
  std::optional<SurfacePoint> at(std::uint32_t page, int x, int y) const;
  std::size_t bytes() const; // of memory held

private:
  // Rows of texels that are rasterised together. A texel of one triangle needs its number only: most are of one.
  struct Band {
    std::vector<std::uint32_t> texels; // row by row: a triangle's number over all instances, kNone, or kMixed + n
    std::vector<std::uint32_t> mixed;  // blocks n of factor^2 sub-texels: a triangle's number or kNone
    std::vector<Texel> covered;        // until they are joined into m_texels
  };
  class BandRaster;

  std::uint32_t instanceOf(std::uint32_t triangle) const;
  std::uint32_t triangleAt(std::uint32_t page, int x, int y) const;

  const scenes::Scene& m_scene;
  const Atlas& m_atlas;
  int m_factor;
  std::vector<Texel> m_texels;
  std::size_t m_bandsPerPage = 0;
  std::vector<Band> m_bands;
  std::vector<std::uint32_t> m_firstTriangle; // of each instance in the numbering, and their count at the end
};

} // namespace parity::bake
