// The irradiance of a whole scene as far as it is known: what a ray finds where it ends.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas/atlas.h"
#include "bake/atlas/texels.h"
#include "lighting/surface/visibility.h"

namespace parity::bake {

class ReflectedLight {
public:
  // irradiance: one a texel of the grid, linear Rec.709; isValid: whether it is known. Texels that are not known, and
  // those beside the charts, get the mean of their neighbours'. The atlas must outlive it.
  ReflectedLight(const Atlas& atlas, const TexelGrid& grid, const std::vector<glm::vec3>& irradiance,
                 const std::vector<bool>& isValid);

  // Irradiance there, bilinear; black for an object without a lightmap.
  glm::vec3 irradiance(const lighting::Visibility::Hit& hit) const;

private:
  const Atlas& m_atlas;
  std::vector<std::vector<glm::vec3>> m_pages; // row by row
};

} // namespace parity::bake
