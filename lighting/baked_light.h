// Baked light as the paths read it: lightmaps, the sun's shadow, environment captures.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "base/image/image.h"
#include "lighting/environment/environment_light.h"
#include "scenes/gltf/lightmap_uvs.h"

namespace parity::lighting {

// The luminance of lightmaps (Unreal Engine 4's weights, docs/shading.md 7a).
inline double lightmapLuminance(const glm::dvec3& c) { return 0.3 * c.x + 0.59 * c.y + 0.11 * c.z; }

// What point and spot lights are: static ones are in all lightmaps and nowhere else; stationary ones are in the LQ
// lightmap alone (their bounces in both), paths with other lightmaps shade them themselves.
enum class LocalLights { isStatic, isStationary };

// An environment capture: the scene as it is seen from a point.
struct BakedCapture {
  glm::vec3 position{0.f}, boxLower{0.f}, boxUpper{0.f}; // world; the box: what parallax is corrected for
  float radius = 0;                                      // metres that its influence reaches
  std::shared_ptr<const EnvironmentLight> light;

  // Luminance (.3, .59, .11) of its mean radiance: what mobile's normalisation divides by (docs/shading.md 7a).
  float averageBrightness() const;
};

// Pages are of one size, each two halves of equal height, one above the other (shading/lightmap.glsl).
struct BakedLight {
  LocalLights localLights = LocalLights::isStatic;
  scenes::LightmapUvs uvs;
  std::vector<base::BasicImage<std::uint16_t>> halfPages; // RGBA16F
  std::vector<base::Image8> lqPages;                      // RGBA, Unreal Engine 4's LQ encoding, as decoded from ASTC
  std::vector<glm::vec4> lqScales;    // four an instance: scale, add of the upper half; of the lower
  std::vector<base::Image8> sunMask;  // share of sub-texels that the sun reaches; empty without a sun
  std::vector<base::Image8> sunField; // the distance field of that
  float transitionScale = 1;          // T of the distance field
  std::vector<BakedCapture> captures;
};

} // namespace parity::lighting
