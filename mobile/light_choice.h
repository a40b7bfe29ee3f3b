// Which lights the mobile path evaluates, one sun and up to four local lights an object or all; and which it drops.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gpu/shaders/interface.h"
#include "mobile/options.h"
#include "paths/path.h"
#include "scenes/scene.h"

namespace parity::mobile {

using gpu::kLightsPerObject;
using gpu::kNoLight;

// For each instance the indices (into `lights`) of its up to four local lights, the rest kNoLight. The rule: lights are
// ranked by the luminance of their illuminance at the point of the object's bounding sphere nearest to the light (at
// the light itself where it is inside), with distance attenuation and range, the cone counted as open where it may
// touch the sphere; ties go to the lower index; lights whose range or cone does not reach the sphere are left out.
std::vector<std::array<std::uint32_t, kLightsPerObject>> chooseLocalLights(const scenes::Scene& scene,
                                                                           std::span<const scenes::Light> lights);

using paths::LightUse;

// How many local lights an object is shaded with: none (they are baked), up to four, or all that there are.
enum class LightLimit { none, four, all };

LightLimit lightLimitOf(const Options& options);

// Of each light, over the instances with pixels. Directional lights reach every object, all but the brightest are
// dropped; of local lights those that an object's range and cone rule lets in and that are beyond its limit. A light
// that is black reaches nothing. pixels: a number for each instance, 0: not asked about.
std::vector<LightUse> countLightUse(const scenes::Scene& scene, std::span<const scenes::Light> lights, LightLimit limit,
                                    std::span<const std::uint64_t> pixels);

// Whether countLightUse can find any to be dropped; quick.
bool mayDropLights(std::span<const scenes::Light> lights, LightLimit limit);

} // namespace parity::mobile
