#include "scenes/brightest_light.h"

#include "scenes/luminance.h"

namespace parity::scenes {

std::optional<std::size_t> brightestOf(std::span<const Light> lights, LightKind kind) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].kind == kind && (!best || luminanceOf(lights[i].color) > luminanceOf(lights[*best].color))) best = i;
  return best;
}

} // namespace parity::scenes
