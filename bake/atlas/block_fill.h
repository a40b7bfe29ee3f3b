// What a lightmap's texels hold that nobody owns: blocks that are compressed as one must not see garbage in them.
#pragma once

#include <cstdint>

#include "base/image/image.h"

namespace parity::bake {

// Gives texels without an owner, in blocks of side x side where others have one, what goes on smoothly from those,
// ring by ring; alpha stays. codes: RGBA of the owners' size, or several of them one above the other.
//
// Left black, they would cost the others, where two in five texels are owned, 2 dB of colour and 5 of direction at 4x4,
// 8 at 6x6. The mean of the block's is .5 to 3 dB worse; to look at other blocks' texels, too, up to 4 dB.
void fillBlocks(const base::BasicImage<std::uint32_t>& owner, int side, base::Image8& codes);

} // namespace parity::bake
