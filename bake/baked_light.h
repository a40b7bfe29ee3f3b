// Baked light as the two paths read it, and what is told of it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bake/scene_hash.h"
#include "base/image.h"
#include "lighting/environment_light.h"
#include "scenes/lightmap_uvs.h"

namespace parity::bake {

// What point and spot lights are: static ones are in the lightmaps of both paths and nowhere else; stationary ones are
// in mobile's alone (their bounces in both), the high-end path shades them itself.
enum class LocalLights { isStatic, isStationary };

// An environment capture: the scene as it is seen from a point.
struct Capture {
  glm::vec3 position{0.f}, boxLower{0.f}, boxUpper{0.f}; // world; the box: what parallax is corrected for
  float radius = 0;                                      // metres that its influence reaches
  std::shared_ptr<const lighting::EnvironmentLight> light;

  // Luminance (.3, .59, .11) of its mean radiance: what mobile's normalisation divides by (SHADING 7).
  float averageBrightness() const;
};

inline constexpr double kNoLossDb = 999; // in place of infinity, which JSON has not

// Told in reports: figures of the bake itself.
struct BakeFigures {
  std::uint64_t texels = 0;                                    // of charts
  double samplesPerTexel = 0, errorMedian = 0, errorWorst = 0; // of the gathered light
  double shareWithinError = 1;                                 // of texels that reached the wanted error
  double quantizedError = 0,
         storedError = 0; // rms of what mobile decodes, in 8 bits and after ASTC (bake/lq_encoding.h)
  double colorDb = kNoLossDb, directionDb = kNoLossDb; // that ASTC leaves their codes
};

struct BakedLight {
  std::string scene;    // its name
  std::string settings; // in words
  std::string astc;     // "4x4", "6x6" or "none"
  SceneHashes hashes;
  LocalLights localLights = LocalLights::isStatic;
  int pageSide = 0;
  scenes::LightmapUvs uvs;
  std::vector<base::Image> sources;                     // of each page: irradiance RGB, SH, normal: 10 channels
  std::vector<base::BasicImage<std::uint16_t>> highend; // RGBA16F, halves stacked: shading/lightmap.glsl
  std::vector<base::Image8> mobile;                     // RGBA, halves stacked, as decoded from ASTC
  std::vector<glm::vec4> mobileScales;                  // four an instance: scale, add of the upper half; of the lower
  std::vector<base::Image8> sunMask;                    // share of sub-texels that the sun reaches; empty without a sun
  std::vector<base::Image8> sunField;                   // the distance field of that
  float transitionScale = 1;                            // T of the distance field
  std::vector<Capture> captures;
  BakeFigures figures;
};

} // namespace parity::bake
