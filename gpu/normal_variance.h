// How far the normals of a normal map spread within each texel of its mips.
#pragma once

#include <vector>

#include "base/image.h"

namespace parity::gpu {

// Writes into the alpha channel of every mip of a normal map (RGBA8, base level first, each half the one before) the
// growth of alpha^2 by shading/specular_aa.glsl, as its square root: code / 255 squared, so that a step near 0 is
// 1.5e-5. Averages of the base level's normals, each made unit first; the base level itself and any map of
// equal normals get exactly 0. RGB stays. A texel without direction counts as (0, 0, 1).
void writeNormalVariance(std::vector<base::Image8>& mips);

} // namespace parity::gpu
