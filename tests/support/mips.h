// Whole chains of mips.
#pragma once

#include <vector>

#include "gpu/surface/mips.h"

namespace parity::tests {

// All mips of an RGBA8 image down to 1x1, the base level first.
inline std::vector<base::Image8> makeMips(const base::Image8& image, bool srgb) {
  std::vector<base::Image8> mips{image};
  while (mips.back().width > 1 || mips.back().height > 1) mips.push_back(gpu::makeNextMip(mips.back(), srgb));
  return mips;
}

} // namespace parity::tests
