// An independent truth for the display "ACES SDR": the Academy's ACES 1.0.3 CTL sources, written down in double
// precision.
#pragma once

#include <array>

namespace parity::base {

// RRT and ODT.Academy.sRGB_100nits_dim of linear Rec.709, adapted from D65 to the ACES white by Bradford.
// Returns sRGB-encoded values in [0,1].
std::array<double, 3> acesReference(const std::array<double, 3>& linearRec709);

} // namespace parity::base
