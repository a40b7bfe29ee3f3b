// One bilinear reading of a cube's level, in double precision.
#pragma once

#include <algorithm>

#include "lighting/environment/cube_sampler.h"

namespace parity::tests {

// direction: any length but 0.
inline glm::dvec4 readLevel(const lighting::CubeLevel& level, const glm::dvec3& direction) {
  const lighting::FacePoint p = lighting::facePointOf(direction);
  const double n = level.stride - 2; // the middle of the rim's first texel lies at 0
  const double x = std::max((p.s / 2 + 0.5) * n + 0.5, 0.0), y = std::max((p.t / 2 + 0.5) * n + 0.5, 0.0);
  const int x0 = std::min(static_cast<int>(x), level.stride - 2), y0 = std::min(static_cast<int>(y), level.stride - 2);
  const auto at = [&](int column, int row) {
    return glm::dvec4(level.faces[(static_cast<std::size_t>(p.face) * level.stride + row) * level.stride + column]);
  };
  return glm::mix(glm::mix(at(x0, y0), at(x0 + 1, y0), x - x0), glm::mix(at(x0, y0 + 1), at(x0 + 1, y0 + 1), x - x0),
                  y - y0);
}

} // namespace parity::tests
