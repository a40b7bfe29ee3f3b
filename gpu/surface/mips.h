// Mips made on the CPU, alike on every device.
#pragma once

#include "base/image/image.h"

namespace parity::gpu {

// The next mip of an RGBA8 image, each side half as long, rounded down, and at least 1: area-weighted averages (exact
// for odd sizes too), in linear light where srgb says that RGB is sRGB-encoded.
base::Image8 makeNextMip(const base::Image8& image, bool srgb);

} // namespace parity::gpu
