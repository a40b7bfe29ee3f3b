// Light that arrives at a texel, and how it is summed.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

#include "lighting/baked_light.h"

namespace parity::bake {

// Plain data: cached as it is.
struct TexelLight {
  glm::vec3 irradiance{0.f}; // linear Rec.709, of the front
  glm::vec3 back{0.f};       // the same of the back of a double-sided surface
  glm::vec4 sh{0.f};         // as LightmapPage::sh
  TexelLight& operator+=(const TexelLight& other) {
    irradiance += other.irradiance;
    back += other.back;
    sh += other.sh;
    return *this;
  }
  TexelLight scaledBy(float scale) const { return {irradiance * scale, back * scale, sh * scale}; }
};

inline constexpr double kY0 = 0.282094791773878143, kY1 = 0.488602511902919921;

using lighting::lightmapLuminance;

// Light of a direction (unit): `flux` is radiance times solid angle; cosine: of the direction and the texel's normal,
// negative where it comes to the back.
struct LightSum {
  glm::dvec3 irradiance{0.0}, back{0.0};
  glm::dvec4 sh{0.0};
  void add(const glm::dvec3& flux, const glm::dvec3& direction, double cosine) {
    (cosine < 0 ? back : irradiance) += flux * std::abs(cosine);
    const double luminance = lightmapLuminance(flux);
    sh += glm::dvec4(luminance * kY0, luminance * kY1 * direction);
  }
  LightSum& operator+=(const LightSum& other) {
    irradiance += other.irradiance;
    back += other.back;
    sh += other.sh;
    return *this;
  }
  LightSum scaledBy(double scale) const { return {irradiance * scale, back * scale, sh * scale}; }
  TexelLight times(double scale) const {
    return {glm::vec3(irradiance * scale), glm::vec3(back * scale), glm::vec4(sh * scale)};
  }
};

} // namespace parity::bake
