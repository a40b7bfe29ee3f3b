// The magma colour map, in which FLIP maps are shown.
#pragma once

#include <array>
#include <cstdint>

#include "base/image/image.h"

namespace parity::compare {

// 8-bit sRGB of entry 0..255 (S. van der Walt and N. Smith 2015, matplotlib, CC0).
std::array<std::uint8_t, 3> magmaColor(int index);

// map: 1 channel in [0,1] (clamped). Returns 8-bit sRGB, entry int(255 v + 0.5) of the table. Throws Error (failed) for
// other than 1 channel or a value that is not finite.
base::Image8 magmaImage(const base::Image& map);

} // namespace parity::compare
