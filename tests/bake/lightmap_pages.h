// Pages of lightmaps made by hand, and a decoder of the mobile ones written from docs/shading.md 7a alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

#include "bake/encode/lightmap_page.h"
#include "bake/encode/lq_encoding.h"

namespace parity::bake {

inline constexpr double kTestPi = 3.141592653589793;

inline double lumaOf(const glm::dvec3& c) { return .3 * c.r + .59 * c.g + .11 * c.b; }

// Without owners.
inline LightmapPage makePage(int width, int height) {
  LightmapPage page;
  page.owner = {width, height, 1, kNoInstance};
  page.irradiance = {width, height, 3};
  page.sh = {width, height, 4};
  page.normal = {width, height, 3};
  return page;
}

// l1: over x, y, z of the world.
inline void setTexel(LightmapPage& page, int x, int y, std::uint32_t owner, const glm::dvec3& irradiance, double l0,
                     const glm::dvec3& l1, const glm::dvec3& normal) {
  *page.owner.at(x, y) = owner;
  page.sh.at(x, y)[0] = static_cast<float>(l0);
  for (int c = 0; c < 3; ++c) {
    page.irradiance.at(x, y)[c] = static_cast<float>(irradiance[c]);
    page.sh.at(x, y)[1 + c] = static_cast<float>(l1[c]);
    page.normal.at(x, y)[c] = static_cast<float>(normal[c]);
  }
}

// Light that reaches a white diffuser alike from everywhere: the colour that is stored, C = E/pi / .282095, is `color`.
inline void setEven(LightmapPage& page, int x, int y, std::uint32_t owner, const glm::dvec3& color) {
  setTexel(page, x, y, owner, color * (.282095 * kTestPi), lumaOf(color) > 0 ? 1 : 0, glm::dvec3(0), {0, 1, 0});
}

struct DecodedTexel {
  glm::dvec3 color{0};                            // C, what directionality multiplies
  double L = 0;                                   // its luminance
  glm::dvec4 sh{0};                               // along y, z, x, and the constant
  glm::dvec3 at(const glm::dvec3& normal) const { // radiance of a white diffuser
    return color * std::max(0.0, glm::dot(sh, glm::dvec4(normal.y, normal.z, normal.x, 1)));
  }
};

inline DecodedTexel decodeTexel(const base::Image8& halves, int x, int y, const LqScales& scales) {
  const std::uint8_t *upper = halves.at(x, y), *lower = halves.at(x, y + halves.height / 2);
  glm::dvec3 logRgb;
  DecodedTexel texel;
  for (int c = 0; c < 3; ++c) logRgb[c] = upper[c] / 255.0 * scales.colorScale[c] + scales.colorAdd[c];
  for (int c = 0; c < 4; ++c) texel.sh[c] = lower[c] / 255.0 * scales.directionScale[c] + scales.directionAdd[c];
  const double logL = lumaOf(logRgb);
  texel.L = std::exp2(16 * logL - 8) - 1.0 / 256;
  texel.color = logL > 0 ? logRgb * (texel.L / logL) : glm::dvec3(0);
  return texel;
}

} // namespace parity::bake
