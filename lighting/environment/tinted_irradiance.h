// Irradiance as a quadratic form of the normal whose second band has one tint, for the mobile preset refit.
#pragma once

#include <array>

#include <glm/glm.hpp>

namespace parity::lighting {

// The numbers of shading/tinted_sky.glsl's TintedSky. Of a black environment all are 0.
struct TintedIrradiance {
  std::array<glm::vec3, 4> linear{}; // of 1, x, y, z
  glm::vec3 tint{0.f};
  std::array<float, 5> quadratic{}; // of x^2, xy, xz, y^2, yz
};

// From irradiance coefficients as shading/sh.glsl evaluates them (lighting/environment/irradiance_sh.h): the first four
// as they are, the second band's five of three channels replaced by the nearest matrix of rank 1 (Eckart and Young
// 1936), least squares over all normals. A grey environment loses nothing by it. Deterministic.
TintedIrradiance tintIrradiance(const std::array<glm::vec3, 9>& irradianceSh);

} // namespace parity::lighting
