// A frame as a screen shows it: display transform, 8 bits, and what becomes of NaN.
#pragma once

#include <cstdint>
#include <vector>

#include "base/image/color.h"
#include "base/image/image.h"

namespace parity::job {

struct Displayed {
  base::Image8 pixels; // RGB as written to PNG; non-finite pixels are black
  std::vector<std::uint32_t>
      nonFinite; // y*width+x of pixels that are not finite in the frame or once exposed; ascending
};

// color: linear scene-referred RGB.
Displayed displayImage(const base::Image& color, const base::DisplayTransform& display, float exposureEv);

// The frame as the camera's exposure makes it: what linear figures are measured on.
base::Image expose(const base::Image& color, float exposureEv);

} // namespace parity::job
