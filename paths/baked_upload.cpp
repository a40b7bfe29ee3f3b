#include "paths/baked_upload.h"

namespace parity::paths {

std::vector<gpu::GpuCapture> capturesOf(const lighting::BakedLight& baked, bool isNormalised) {
  std::vector<gpu::GpuCapture> captures;
  for (const lighting::BakedCapture& c : baked.captures)
    captures.push_back({glm::vec4(c.position, c.radius),
                        glm::vec4(c.boxLower, isNormalised ? c.averageBrightness() : 0.f), glm::vec4(c.boxUpper, 0)});
  return captures;
}

} // namespace parity::paths
