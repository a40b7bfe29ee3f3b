// A frame as a screen shows it: display transform, 8 bits, and what becomes of NaN.
#pragma once

#include "base/color.h"
#include "base/image.h"

namespace parity::job {

struct Displayed {
  base::Image8 pixels;  // RGB as written to PNG; non-finite pixels are black
  base::Image finite;   // pixels / 255: what FLIP sees
  base::Image measured; // the same with NaN where the frame is not finite: those pixels are counted, not passed
};

// color: linear scene-referred RGB.
Displayed displayImage(const base::Image& color, const base::DisplayTransform& display, float exposureEv);

// Sets `map` (1 channel) to 1, the largest error there is, wherever `measured` is not finite.
void markNonFinite(base::Image& map, const base::Image& measured);

// value * 255 + 0.5, clamped to [0,255].
base::Image8 quantize(const base::Image& display);

} // namespace parity::job
