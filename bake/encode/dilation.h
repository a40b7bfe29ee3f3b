// Texels that nothing covers, filled from their neighbours.
#pragma once

#include <cstdint>

#include "bake/encode/lightmap_page.h"
#include "base/image/image.h"

namespace parity::bake {

// Fills texels without an owner, `texels` rings outwards: each ring from the mean of those of the eight neighbours that
// were filled before it. Where these are of several instances, only those of the least number count, which becomes the
// owner, too: no light is mixed between objects. Normals are made unit again.
//
// invalid (1 channel, empty: none): where it is not 0, the texel has an owner, but its values are not to be trusted
// (inside of something). Such texels are filled first, however many rings it takes, and from valid texels of their own
// instance only; they keep what they have where no such neighbour is ever reached.
void dilate(LightmapPage& page, int texels, const base::Image8& invalid = {});

// The same for values of 8 bits, such as a shadow mask, rounded; owner has the image's size and is filled, too.
void dilate(base::Image8& values, base::BasicImage<std::uint32_t>& owner, int texels, const base::Image8& invalid = {});

} // namespace parity::bake
