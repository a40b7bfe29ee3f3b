// Scenes whose irradiance is known, and baking them.
#pragma once

#include <cmath>
#include <vector>

#include "bake/light/integrate.h"
#include "support/matte_scenes.h"

namespace parity::bake::tests {

using namespace parity::tests;

// Irradiance of a polygon of even radiance (Lambert 1760): E = L/2 sum of angle_i (n . cross_i).
inline double lambert(const std::vector<glm::dvec3>& polygon, const glm::dvec3& at, const glm::dvec3& normal) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = glm::normalize(polygon[i] - at), b = glm::normalize(polygon[(i + 1) % polygon.size()] - at);
    sum += std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::dot(normal, glm::normalize(glm::cross(a, b)));
  }
  return std::abs(sum) / 2;
}

// A scene's atlas, texels and light together.
struct Baked {
  Atlas atlas;
  TexelGrid grid;
  StaticLight light;

  Baked(const scenes::Scene& scene, const BakeLights& lights, IntegrateOptions options = {}, double texelsPerMetre = 8,
        const Control& control = {})
      : atlas(makeAtlas(scene, {.texelsPerMetre = texelsPerMetre})), grid(scene, atlas, 4),
        light(integrate(scene, atlas, grid, lights, withDensity(options, texelsPerMetre), control)) {}

  // Of texels whose sub-texels are all there: what direct and gathered light make of them.
  template <typename Body> void forWhole(const Body& body) const {
    for (std::size_t i = 0; i < grid.texels().size(); ++i)
      if (light.valid[i] == 0xffff) {
        const Texel& t = grid.texels()[i];
        const auto a = grid.at(t.page, 4 * t.x + 1, 4 * t.y + 1), b = grid.at(t.page, 4 * t.x + 2, 4 * t.y + 2);
        SurfacePoint middle = *a;
        middle.position = 0.5f * (a->position + b->position);
        body(middle, light.direct[i], light.gathered[i]);
      }
  }

private:
  static IntegrateOptions withDensity(IntegrateOptions options, double texelsPerMetre) {
    options.texelsPerMetre = texelsPerMetre;
    return options;
  }
};

} // namespace parity::bake::tests
