// What an unwrap must know of a mesh: its faces' areas and normals, and which faces meet at an edge.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::bake {

inline constexpr std::uint32_t kNoFace = 0xffffffffu;

// Vertices at the same place count as one.
struct MeshFaces {
  std::vector<glm::dvec3> normals;          // unit, of the front; 0 for a face without area
  std::vector<double> areas;                // of the mesh's own units; 0 for a face without area
  std::vector<std::uint32_t> neighbours;    // 3 a face: the one beyond the edge from corner k to k + 1, or kNoFace
  std::vector<std::uint32_t> weldedCorners; // 3 a face: the first vertex at the corner's place
  double area = 0;                          // of all

  std::size_t count() const { return areas.size(); }
};

// A face is without area where its height is below 1e-7 of its longest edge: its normal would be noise. An edge of more
// than two faces joins none: they lie over each other, or meet like the pages of a book.
MeshFaces makeMeshFaces(const scenes::Mesh& mesh);

} // namespace parity::bake
