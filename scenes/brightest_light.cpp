#include "scenes/brightest_light.h"

namespace parity::scenes {

namespace {

float luminanceOf(const glm::vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

} // namespace

std::optional<std::size_t> brightestOf(std::span<const Light> lights, LightKind kind) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].kind == kind && (!best || luminanceOf(lights[i].color) > luminanceOf(lights[*best].color))) best = i;
  return best;
}

} // namespace parity::scenes
