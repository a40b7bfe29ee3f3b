// Sun masks of known shadows.
#pragma once

#include <cstdint>

#include "bake/encode/sun_mask.h"

namespace parity::bake {

// `size` texels a side with two unknown ones around; isShadowed(x, y) of sub-texels' middles, texels from the middle.
template <typename IsShadowed> SunMask makeSunMask(int size, int factor, const IsShadowed& isShadowed) {
  SunMask mask;
  mask.factor = factor;
  mask.sight = base::Image8(size * factor, size * factor, 1, kUnknown);
  mask.owner = base::BasicImage<std::uint32_t>(size, size, 1, 0);
  for (int y = 2 * factor; y < (size - 2) * factor; ++y)
    for (int x = 2 * factor; x < (size - 2) * factor; ++x)
      *mask.sight.at(x, y) =
          isShadowed((x + 0.5) / factor - 0.5 * size, (y + 0.5) / factor - 0.5 * size) ? kShadowed : kLit;
  return mask;
}

} // namespace parity::bake
