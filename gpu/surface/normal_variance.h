// How far the normals of a normal map spread within each texel of its mips.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "base/image/image.h"

namespace parity::gpu {

// What is uploaded as a normal map's base level: alpha 0, no spread. RGBA8.
base::Image8 withoutVariance(base::Image8 image);

// Walks the mips of one normal map (RGBA8) and writes into their alpha the growth of alpha^2 by
// shading/specular_aa.glsl, as its square root: code / 255 squared, so that a step near 0 is 1.5e-5. Averages of the
// base level's normals, each made unit first; any map of equal normals gets exactly 0. RGB stays. A texel without
// direction counts as (0, 0, 1).
class NormalVariance {
public:
  // finer: the base level at the first call, then the `mip` of the call before; its RGB is read.
  void writeNext(const base::Image8& finer, base::Image8& mip);

private:
  std::vector<glm::vec3> m_means; // of the last mip's texels
};

} // namespace parity::gpu
