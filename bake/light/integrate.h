// The static light of a scene, texel by texel of its atlas.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bake/atlas/texels.h"
#include "bake/encode/lightmap_page.h"
#include "bake/light/texel_light.h"
#include "base/cache.h"
#include "scenes/scene.h"

namespace parity::bake {

// What lights the scene besides its emissive surfaces.
struct BakeLights {
  std::vector<scenes::Light> lights;              // of all kinds
  std::optional<std::size_t> sun;                 // among them: what comes straight from it is not in the lightmap
  std::optional<scenes::Environment> environment; // without the suns that are among the lights
};

struct IntegrateOptions {
  int bounces = 2; // of diffuse light from surface to surface, 0..kMaxBounces
  // Wanted error, which 19 of 20 texels are within, over the texel's irradiance, or over a tenth of the mean where it
  // is darker.
  double error = 0.01;
  // Of a texel in the mean over the bake, whatever its error: those that need fewer leave theirs to others, which take
  // up to four times as many. A power of two, kMinSamples..kMaxSamples.
  int maxSamples = 4096;
  std::uint32_t seed = 0;
  double texelsPerMetre = 16; // of the atlas
};
inline constexpr int kMaxBounces = 100, kMinSamples = 512, kMaxSamples = 1 << 20;

// Who watches over the work, and where what is done is kept.
struct Control {
  std::function<void(const std::string& what, double done)> progress = {}; // done: 0..1 of all; one call at a time
  std::function<bool()> isCancelled = {};                                  // asked often, by any thread
  const base::Cache* cache = nullptr;                                      // null: nothing is kept
  std::string key; // of the scene, the settings and the build: of all that decides the result
};

// Of every texel of the grid, in its order.
struct StaticLight {
  std::vector<TexelLight> direct;      // of lights that are neither the sun nor emissive surfaces
  std::vector<TexelLight> gathered;    // the sky, emissive surfaces and all reflected light, the sun's too
  std::vector<std::uint16_t> valid;    // a bit for each sub-texel whose surface can be seen; none: within other objects
  std::vector<std::uint16_t> sunLit;   // a bit for each sub-texel that the sun reaches
  std::vector<std::uint16_t> facesSun; // a bit for each that is turned towards the sun; the others tell nothing of it
  std::vector<float> error;            // achieved, of luminance, as IntegrateOptions::error
  std::vector<std::uint32_t> samples;  // taken for `gathered`
  std::uint64_t rays = 0;              // of all kinds; of what came from the cache none
};

// Deterministic: what a texel gets depends on the inputs and the seed alone, not on threads or on what was cached.
// grid: of factor 4. Throws base::Error (exit 4, "cancelled") where it was; what had been done is in the cache.
StaticLight integrate(const scenes::Scene& scene, const Atlas& atlas, const TexelGrid& grid, const BakeLights& lights,
                      const IntegrateOptions& options, const Control& control = {});

// A page, not dilated, and which of its owned texels nothing is known of (1 channel, 1 there): they lie in other
// objects.
struct IntegratedPage {
  LightmapPage page;
  base::Image8 invalid;
};

// Gathered light, with the direct light or without.
std::vector<IntegratedPage> makePages(const scenes::Scene& scene, const Atlas& atlas, const TexelGrid& grid,
                                      const StaticLight& light, bool withDirect);

} // namespace parity::bake
