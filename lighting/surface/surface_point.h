// The point where a ray meets a surface: its normals, and where the smooth surface lies that its triangles stand for.
#pragma once

#include <glm/glm.hpp>

#include "lighting/surface/texture_read.h"
#include "lighting/surface/visibility.h"
#include "scenes/scene.h"

namespace parity::lighting {

// World space, metres; normals are unit.
struct SurfacePoint {
  glm::dvec3 position{0.0};  // on the triangle
  glm::dvec3 geometric{0.0}; // the triangle's, on the side that is looked at
  glm::dvec3 smooth{0.0};    // the vertices', interpolated; turned round where a back is looked at
  glm::dvec3 lift{0.0};      // from position to the smooth surface above a coarse convex one; else 0
};

// Where that is in the triangle.
TrianglePoint trianglePointOf(const scenes::Mesh& mesh, const Visibility::Hit& hit);

// The point of a hit, looked at along `direction` (of the ray). Normals are those that the paths shade with
// (gpu/shaders/resolve.comp).
// lift: of Hanika 2021, "Hacking the Shadow Terminator" (Ray Tracing Gems II, chapter 4): the point is projected onto
// the tangent planes of the three vertices, as far as it lies below them, and the projections are interpolated,
//   lift = sum w_i max(0, -(P - V_i) . n_i) n_i.
// Rays that begin there see what the surface that the normals tell of would see; a flat or concave triangle has none.
SurfacePoint surfacePointAt(const scenes::Scene& scene, const Visibility::Hit& hit, const glm::dvec3& direction);

} // namespace parity::lighting
