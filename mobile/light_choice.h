// Which lights the mobile path evaluates: one sun, and up to four local lights an object.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gpu/shaders/interface.h"
#include "scenes/scene.h"

namespace parity::mobile {

using gpu::kLightsPerObject;
using gpu::kNoLight;

// Index of the brightest directional light by luminance (the first among equals), or nothing.
std::optional<std::size_t> chooseSun(std::span<const scenes::Light> lights);

// Index of the spot light that casts a shadow: the brightest by luminous intensity (the first among equals), or
// nothing.
std::optional<std::size_t> chooseShadowSpot(std::span<const scenes::Light> lights);

// For each instance the indices (into `lights`) of its up to four local lights, the rest kNoLight. The rule: lights are
// ranked by the luminance of their illuminance at the point of the object's bounding sphere nearest to the light (at
// the light itself where it is inside), with distance attenuation and range, the cone counted as open where it may
// touch the sphere; ties go to the lower index; lights whose range or cone does not reach the sphere are left out.
std::vector<std::array<std::uint32_t, kLightsPerObject>> chooseLocalLights(const scenes::Scene& scene,
                                                                           std::span<const scenes::Light> lights);

} // namespace parity::mobile
