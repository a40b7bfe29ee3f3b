#include "bake/encode/half_encoding.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/parallel.h"
#include "shading/shading.h"

namespace parity::bake {

namespace {

using std::numbers::pi;

std::uint16_t bitsOf(double value) { return shading::Half(std::clamp(value, -65504.0, 65504.0)).bits(); }

shading::f64::real3 directionOf(const float* sh) {
  return shading::f64::encodeLightmapDirection(sh[0], {sh[1], sh[2], sh[3]});
}

} // namespace

base::BasicImage<std::uint16_t> encodeHalves(const LightmapPage& page) {
  base::BasicImage<std::uint16_t> halves(page.owner.width, 2 * page.owner.height, 4, bitsOf(1));
  const std::size_t below = page.owner.pixelCount();
  base::parallelFor(below, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::uint16_t *upper = halves.pixels.data() + 4 * i, *lower = upper + 4 * below;
      const auto r = directionOf(page.sh.pixels.data() + 4 * i);
      const std::array<double, 3> direction = {r.x, r.y, r.z};
      const float* normal = page.normal.pixels.data() + 3 * i;
      if (page.owner.pixels[i] != kNoInstance && normal[0] == 0 && normal[1] == 0 && normal[2] == 0)
        upper[3] = bitsOf(0);
      for (int c = 0; c < 3; ++c) {
        upper[c] = bitsOf(page.irradiance.pixels[3 * i + static_cast<std::size_t>(c)] / pi);
        lower[c] = bitsOf(direction[static_cast<std::size_t>(c)]);
      }
    }
  });
  return halves;
}

} // namespace parity::bake
