// Suns, point and spot lights in closed form.
#pragma once

#include <vector>

#include "reference/lobes.h"
#include "reference/point_visibility.h"
#include "scenes/scene.h"

namespace parity::reference {

// Reflected radiance, by the kind of light.
struct DirectLight {
  glm::dvec3 sunDiffuse{0.0}, sunSpecular{0.0}, localDiffuse{0.0}, localSpecular{0.0};
};

// The high-end path's formulas in double, its conventions included: analytic lights see no roughness below 1/64, NoV is
// at least 1e-4, occlusion does not act on them; each light's own fall-off (scenes::Falloff), KHR_lights_punctual's
// cones. albedo: as for Lobes. fromHere: of the sample; below its horizon
// the specular lobe is folded up (reference/reflection.h).
DirectLight shadeDirect(const SurfaceSample& sample, const std::vector<scenes::Light>& lights, const Model& model,
                        const DirectionalAlbedo* albedo, const PointVisibility& fromHere = {});
// The same of lobes that the caller made, with no floor of the roughness.
DirectLight shadeDirect(const SurfaceSample& sample, const std::vector<scenes::Light>& lights, const Lobes& lobes,
                        const PointVisibility& fromHere = {});

// With alpha = 2.4e-4 a point light's reflection has a finite peak; the image light has no floor.
inline constexpr double kMinLightRoughness = 0.015625;
// Of shading normals at or beyond grazing: the lobe of the last visible direction.
inline constexpr double kMinNoV = 1e-4;

} // namespace parity::reference
