// Makes a distance field's texels show, read bilinearly, what the mask shows. Private to
// bake/encode/distance_field.cpp.
#pragma once

#include "bake/encode/mask_blur.h"
#include "base/image/image.h"

namespace parity::bake {

// Changes the codes of a chart's texels by coordinate descent: each code in turn to the best of some steps up and down,
// by the squared error of visibility at the chart's sub-texels that read it. Texels two apart share no sub-texel, so a
// sweep does every second texel of every second row at once. target: blurMask's. Ends early once nothing changes.
void fitCodes(const ChartMask& chart, const base::Image& target, double transitionScale, int sweeps,
              base::Image8& codes);

} // namespace parity::bake
