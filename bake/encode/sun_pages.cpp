#include "bake/encode/sun_pages.h"

#include "bake/atlas/texel_points.h"
#include "bake/encode/lightmap_page.h"

namespace parity::bake {

std::vector<SunMask> makeSunMasks(const Atlas& atlas, const TexelGrid& grid, const StaticLight& light) {
  const int side = atlas.pageSide;
  std::vector<SunMask> masks(static_cast<std::size_t>(atlas.pageCount));
  for (SunMask& mask : masks)
    mask = {kFactor, {side * kFactor, side * kFactor, 1, kUnknown}, {side, side, 1, kNoInstance}};
  for (std::size_t i = 0; i < grid.texels().size(); ++i) {
    const Texel& texel = grid.texels()[i];
    SunMask& mask = masks[texel.page];
    *mask.owner.at(texel.x, texel.y) = texel.instance;
    for (int s = 0; s < kFactor * kFactor; ++s)
      if ((light.valid[i] & light.facesSun[i] & 1 << s) != 0)
        *mask.sight.at(texel.x * kFactor + s % kFactor, texel.y * kFactor + s / kFactor) =
            (light.sunLit[i] & 1 << s) != 0 ? kLit : kShadowed;
  }
  return masks;
}

} // namespace parity::bake
