// The high-end lightmap: irradiance and the direction that light comes from, in halves, nothing else lost.
#pragma once

#include <cstdint>

#include "bake/encode/lightmap_page.h"
#include "base/image/image.h"

namespace parity::bake {

// RGBA16F as bits of halves, W x 2 H. Upper half: irradiance / pi, at most 65504; alpha 1
// where it is that of the front, 0 where both sides are seen (LightmapPage::normal is zero). Lower half: r, the
// direction over world's x, y, z, of length 0 (light from everywhere) to 1 (from one direction), alpha 1:
//   r = (l1 / l0) / sqrt(3), cut to length 1; 0 where l0 = 0.
// sqrt(3) = Y1 / Y0: a single directional light has l1 = sqrt(3) l0 w. Texels without an owner hold zeros, alpha 1.
base::BasicImage<std::uint16_t> encodeHalves(const LightmapPage& page);

} // namespace parity::bake
