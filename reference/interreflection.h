// The light that one point reflects of the scene's other surfaces, integrated until its error is small enough.
#pragma once

#include "reference/bounced_light.h"
#include "reference/environment_integral.h"

namespace parity::reference {

// Light that comes by way of at most `bounces` (at least 1) surfaces: the radiance of a direction is that which
// the surface there emits and reflects (reference/bounced_light.h), and none where there is no surface. Three ways of
// sampling - the cosine, GGX's visible normals, the emissive surfaces - joined by the balance heuristic; those that
// cannot help are left out, and a mirror looks in its one direction. Points, replicates and their error are
// integrateEnvironment's. otherLight: what the pixel shows besides; otherError: the standard error of that, each
// channel. Both together reach options.relativeError, or this integral 1/sqrt(2) of it. Occlusion is not applied.
// fromHere: of the sample, and of the visibility of `around`. weight: as for integrateEnvironment.
Integral integrateInterreflection(const SurfaceSample& sample, const Lobes& lobes, const Surroundings& around,
                                  const PointVisibility& fromHere, int bounces, const glm::dvec3& otherLight,
                                  const glm::dvec3& otherError, const IntegralOptions& options,
                                  const glm::dvec3& weight = glm::dvec3(1.0));

} // namespace parity::reference
