// What a scene says about its light as a whole: scales of its parts, and fog.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace parity::scenes {

// Scales of light, each 0..kMaxLightScale. Unreal Engine 4's SkyLightColor, IndirectLightingColorScale and the specular
// scale of its directional light.
struct LightScales {
  glm::vec3 skyLightColor{1.f};      // linear RGB; of the environment's light (not of suns that were extracted from it)
  glm::vec3 indirectColorScale{1.f}; // linear RGB; of the light of lightmaps: without effect where there is none
  float sunSpecularScale = 1;        // of the specular light of directional lights: into their Light::specularScale
  bool operator==(const LightScales&) const = default;
};
inline constexpr float kMaxLightScale = 1000;

// Exponential height fog (shading/fog.glsl): metres, extinction in 1/m. Defaults are Unreal Engine 4's. It lies between
// the eye and the surfaces; the background shows none.
struct Fog {
  float density = 0;                    // extinction at `height`, 1/m, 0..kMaxFogDensity
  float heightFalloff = 0;              // 1/m, 0..kMaxFogFalloff: halves with every 1/heightFalloff metres upwards
  float height = 0;                     // m, -kMaxFogLength..kMaxFogLength
  glm::vec3 color{0.447f, 0.638f, 1.f}; // inscattered radiance where nothing comes through, linear Rec.709
  float startDistance = 0;              // m from the eye, 0..kMaxFogLength
  float maxOpacity = 1;                 // 0..1
  bool operator==(const Fog&) const = default;
  // Whether it changes any picture.
  bool isSeen() const { return density > 0 && maxOpacity > 0; }
};
inline constexpr float kMaxFogDensity = 1000, kMaxFogFalloff = 1000, kMaxFogLength = 1e6f, kMaxFogRadiance = 1e6f;

// How a point or spot light fades with distance, the same in every path (distanceFalloff of shading/light.glsl): by
// KHR_lights_punctual's window, by Unreal Engine 4's, or by the light's own exponent, which no option changes.
enum class Falloff : std::uint8_t { khr, ue4, exponent };
inline constexpr float kMaxFalloffExponent = 1000;
// Those that a run or a suite may choose, in the order of the enumerators: "khr", "ue4".
const std::vector<std::string>& falloffNames();

// What differs from the defaults, in words for reports; empty where nothing does.
std::string describe(const LightScales& scales, const Fog& fog, Falloff falloff);

} // namespace parity::scenes
