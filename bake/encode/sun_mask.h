// What the sun reaches of a page, supersampled: what distance-field shadows start from.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image/image.h"

namespace parity::bake {

// Values of SunMask::sight.
inline constexpr std::uint8_t kShadowed = 0, kLit = 1, kUnknown = 2;

struct SunMask {
  int factor = 4;     // sub-texels along a texel's side, 1..16
  base::Image8 sight; // of each sub-texel of the page; unknown: nothing is there, or it is within other geometry
  // What separates charts that touch: nothing is taken from an owner to another. Of each sub-texel, or of each texel.
  base::BasicImage<std::uint32_t> owner;

  int width() const { return sight.width / factor; } // in texels
  int height() const { return sight.height / factor; }
  std::uint32_t ownerAt(int x, int y) const { // of a sub-texel
    return owner.width == sight.width ? *owner.at(x, y) : *owner.at(x / factor, y / factor);
  }
};

// Sub-texels beside each other that are known and of one owner, corners included.
struct MaskChart {
  struct Run {
    int y, x0, x1; // sub-texels; x1 is behind the last
  };
  std::vector<Run> runs; // by rows
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// All of a page, in the order of their first sub-texels. Throws base::Error (exit 4) where sides or factor do not fit.
std::vector<MaskChart> findCharts(const SunMask& mask);

// The share of a texel's known sub-texels that are lit, in 8 bits. A texel without any has the mean over those of the
// eight around it, so that bilinear reading at the rim of a chart finds no other light; else it is lit.
base::Image8 makeVisibilityMask(const SunMask& mask);

} // namespace parity::bake
