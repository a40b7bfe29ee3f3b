// What the integrator found the sun to reach, page by page, as distance fields start from it.
#pragma once

#include <vector>

#include "bake/encode/sun_mask.h"
#include "bake/light/integrate.h"

namespace parity::bake {

// Sub-texels that lie within other objects or turn away from the sun are unknown.
std::vector<SunMask> makeSunMasks(const Atlas& atlas, const TexelGrid& grid, const StaticLight& light);

} // namespace parity::bake
