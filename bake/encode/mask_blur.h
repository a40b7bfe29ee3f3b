// One chart of a sun mask on its own, and what its shadow looks like behind a penumbra.
#pragma once

#include <vector>

#include "bake/encode/sun_mask.h"
#include "base/image/image.h"

namespace parity::bake {

// The chart's sub-texels, with `margin` texels around the texels that it touches; all else is unknown. May reach beyond
// the page.
struct ChartMask {
  int factor = 1;
  int texelX = 0, texelY = 0; // of its first texel in the page
  base::Image8 sight;

  int width() const { return sight.width / factor; } // in texels
  int height() const { return sight.height / factor; }
};
ChartMask cutChart(const SunMask& mask, const MaskChart& chart, int margin);

// The lit share of the known sub-texels in a square of `penumbra` texels about each known sub-texel's middle, 0..1 (a
// transition of that width, straight where the edge runs along the texels); 0 for unknown ones.
base::Image blurMask(const ChartMask& chart, double penumbra);

// How a bilinear reading at the middle of sub-texel i (>= 0, counted from the first texel's rim) weighs two
// neighbouring texels.
struct BilinearTap {
  int lower;          // index of the first texel, -1 possible; the other is the next
  double upperWeight; // 0..1
};
BilinearTap bilinearTap(int i, int factor);

} // namespace parity::bake
