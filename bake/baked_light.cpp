#include "bake/baked_light.h"

#include "bake/texel_light.h"

#include <numbers>

namespace parity::bake {

float Capture::averageBrightness() const {
  const double luminance = lightmapLuminance(glm::dvec3(light->irradianceSh[0]));
  return static_cast<float>(luminance * kY0 * std::numbers::inv_pi);
}

} // namespace parity::bake
