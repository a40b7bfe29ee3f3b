// A photo studio, a night, plain white.
#include "scenes/builtin/procedural_environment.h"

#include <cmath>
#include <functional>

#include "base/parallel.h"

namespace parity::scenes {
namespace {

Environment makeByFormula(const char* name, const std::function<glm::dvec3(const glm::dvec3&)>& radianceAt) {
  Environment environment;
  environment.name = name;
  environment.radiance = base::Image(kProceduralWidth, kProceduralHeight, 3);
  base::parallelFor(kProceduralHeight, 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < kProceduralWidth; ++x) {
        const glm::dvec3 d = directionAt((x + 0.5) / kProceduralWidth, (y + 0.5) / kProceduralHeight);
        const glm::dvec3 radiance = radianceAt(d);
        for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = static_cast<float>(radiance[c]);
      }
  });
  return environment;
}

// A bright rectangle, seen through a window of the given half sizes on the plane at distance 1.
struct SoftBox {
  double azimuthDeg, elevationDeg, halfWidth, halfHeight;
  glm::dvec3 radiance;

  glm::dvec3 at(const glm::dvec3& d) const {
    const double a = glm::radians(azimuthDeg), e = glm::radians(elevationDeg);
    const glm::dvec3 center(std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a));
    const double depth = glm::dot(d, center);
    if (depth <= 0) return glm::dvec3(0);
    const glm::dvec3 right(-std::sin(a), 0, std::cos(a)), up = glm::cross(center, right);
    const auto inside = [](double x, double half) {
      return 1 - glm::smoothstep(half - 0.06, half + 0.06, std::abs(x)); // cloth: a soft edge
    };
    return radiance * (inside(glm::dot(d, right) / depth, halfWidth) * inside(glm::dot(d, up) / depth, halfHeight));
  }
};

} // namespace

Environment makeStudio() {
  // Key front left, cooler fill right, a rim strip behind, a large one overhead.
  const SoftBox boxes[] = {{125, 38, 0.50, 0.50, {3.6, 3.45, 3.2}},
                           {15, 20, 0.28, 0.80, {1.2, 1.3, 1.5}},
                           {250, 30, 0.16, 0.90, {4.0, 4.0, 4.0}},
                           {0, 89, 0.70, 0.45, {1.1, 1.1, 1.1}}};
  return makeByFormula("studio", [&](const glm::dvec3& d) {
    glm::dvec3 radiance =
        glm::mix(glm::dvec3(0.16, 0.155, 0.15), glm::dvec3(0.34, 0.35, 0.37), glm::smoothstep(-0.35, 0.9, d.y));
    for (const SoftBox& box : boxes) radiance += box.at(d);
    return radiance;
  });
}

Environment makeNight() {
  return makeByFormula("night", [](const glm::dvec3& d) {
    return glm::mix(glm::dvec3(0.012, 0.013, 0.016), glm::dvec3(0.035, 0.045, 0.075), glm::smoothstep(-0.4, 1.0, d.y));
  });
}

Environment makeWhite() {
  return makeByFormula("white", [](const glm::dvec3&) { return glm::dvec3(1.0); });
}

} // namespace parity::scenes
