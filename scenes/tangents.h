// Tangent frames for normal maps, where a file has none.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace parity::scenes {

// Any unit vector at right angles to the unit vector n; continuous but at n.z = 0 (Duff et al. 2017, "Building an
// Orthonormal Basis, Revisited").
glm::vec3 perpendicularTo(const glm::vec3& n);

// Fills mesh.tangents from positions, normals and `uv` (mesh.uv0 or mesh.uv1; empty: all fall back). Per corner the
// direction dP/du of its triangle, laid into the vertex's plane, weighted by the corner's angle, and summed over the
// triangles that meet in the same position, normal and uv with the same orientation of uv. A vertex used by triangles
// of both orientations (a mirrored seam) is split. w is such that w * cross(n, t) runs against v: +Y of a glTF normal
// map is up in the image. Vertices whose triangles have no area in uv get perpendicularTo(n) and w = 1.
// mesh.normals must be there. Returns the number of used vertices that fell back.
std::size_t makeTangents(Mesh& mesh, int texCoord);

// Makes the tangents of a file unit length and w = +-1. One that is zero or not finite becomes perpendicularTo(n).
// Returns how many were replaced.
std::size_t mendTangents(Mesh& mesh);

} // namespace parity::scenes
