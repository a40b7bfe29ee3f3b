// Tangent frames for normal maps and anisotropy, where a file has none.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scenes/gltf/mesh_repair.h"
#include "scenes/scene.h"

namespace parity::scenes {

// Any unit vector at right angles to the unit vector n; continuous but at n.z = 0 (Duff et al. 2017, "Building an
// Orthonormal Basis, Revisited").
glm::vec3 perpendicularTo(const glm::vec3& n);

// Fills mesh.tangents from positions, normals and a uv set (0: mesh.uv0, else mesh.uv1; empty: all fall back) by
// MikkTSpace (scenes/gltf/mikktspace.h). w is such that w * cross(n, t) runs against v: +Y of a glTF normal map is up
// in the image. A vertex whose corners have different tangents (a mirrored seam, corners that only touch) is split.
// Vertices where nothing defines a tangent get perpendicularTo(n) and w = 1. mesh.normals must be there. Returns the
// number of used vertices that fell back. beforeGrowth: told how many vertices come to the mesh, before they do; may
// throw.
std::size_t makeTangents(Mesh& mesh, int texCoord, const std::function<void(std::size_t)>& beforeGrowth = {});
// The memory that it takes for its own meanwhile, at most; what the mesh grows by comes on top.
std::size_t bytesToMakeTangents(const Mesh& mesh);

// Makes the tangents of a file unit length and w = +-1. One that is zero or not finite becomes perpendicularTo(n).
// Returns how many were replaced.
BrokenDirections mendTangents(Mesh& mesh);

} // namespace parity::scenes
