#include "lighting/baked_light.h"

#include <numbers>

namespace parity::lighting {

float BakedCapture::averageBrightness() const {
  constexpr double kY0 = 0.282094791773878143;
  const double luminance = lightmapLuminance(glm::dvec3(light->irradianceSh[0]));
  return static_cast<float>(luminance * kY0 * std::numbers::inv_pi);
}

} // namespace parity::lighting
