// What a path makes of a view: colour, and on request the terms that add up to it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/image/image.h"

namespace parity::base {

// Linear, scene-referred Rec.709 radiance. `terms` is empty, or holds one RGB image per shading::Term in its order;
// their sum is the colour (1e-3 relative in fp32) wherever a material is seen; the background is in no term.
struct Frame {
  Image color;
  std::vector<Image> terms;
};

// The pixels where a material (or any other subject) is seen: indices y*width+x in ascending order.
struct PixelList {
  std::string name;
  std::vector<std::uint32_t> pixels;
  std::vector<float> weights; // share of each pixel in (0,1]; empty: all 1
};

} // namespace parity::base
