// A page of a lightmap as it was integrated: what the encodings start from.
#pragma once

#include <cstdint>

#include "base/image/image.h"

namespace parity::bake {

inline constexpr std::uint32_t kNoInstance = 0xffffffffu;

// All images have the page's size. A texel without an owner holds zeros.
struct LightmapPage {
  base::BasicImage<std::uint32_t> owner; // 1 channel: the instance that the texel is of, or was dilated from
  base::Image irradiance;                // 3 channels: E at the texel's normal, linear Rec.709, radiance times sr
  base::Image sh; // 4 channels: luminance (.3, .59, .11) of incoming radiance on the SH of order 1: l0; l1 along x, y,
                  // z (world): l0 = int L Y0 dw, l1 = int L Y1 w dw with Y0 = .282095, Y1 = .488603
  // 3 channels: the unit normal that E is for, world, before normal maps. Zero where both sides are seen: there E is
  // what the mean of all light would give (pi Y0 l0), and the SH tell one side from the other.
  base::Image normal;
};

} // namespace parity::bake
