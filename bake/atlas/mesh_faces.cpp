// Faces of a mesh and their neighbours, by sorting.
#include "bake/atlas/mesh_faces.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace parity::bake {
namespace {

constexpr double kLeastHeight = 1e-7; // of a face, by its longest edge

// For each vertex the first one at the same place.
std::vector<std::uint32_t> weldVertices(const std::vector<glm::vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) { return std::tuple(positions[i].x, positions[i].y, positions[i].z); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto keyA = key(a), keyB = key(b);
    return keyA != keyB ? keyA < keyB : a < b;
  });
  std::vector<std::uint32_t> welded(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    welded[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? welded[order[i - 1]] : order[i];
  return welded;
}

void joinNeighbours(MeshFaces& faces) {
  struct Edge {
    std::uint32_t low, high, corner;
  };
  std::vector<Edge> edges;
  edges.reserve(faces.count() * 3);
  for (std::size_t face = 0; face < faces.count(); ++face) {
    if (faces.areas[face] == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = faces.weldedCorners[3 * face + k], b = faces.weldedCorners[3 * face + (k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(3 * face + k)});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  });
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) ++end;
    if (end - begin != 2) continue;
    faces.neighbours[edges[begin].corner] = edges[begin + 1].corner / 3;
    faces.neighbours[edges[begin + 1].corner] = edges[begin].corner / 3;
  }
}

} // namespace

MeshFaces makeMeshFaces(const scenes::Mesh& mesh) {
  MeshFaces faces;
  const std::size_t count = mesh.indices.size() / 3;
  faces.normals.assign(count, glm::dvec3(0));
  faces.areas.assign(count, 0);
  faces.neighbours.assign(3 * count, kNoFace);
  faces.weldedCorners.resize(3 * count);
  const std::vector<std::uint32_t> welded = weldVertices(mesh.positions);
  for (std::size_t face = 0; face < count; ++face) {
    std::array<glm::dvec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      faces.weldedCorners[3 * face + k] = welded[mesh.indices[3 * face + k]];
      p[k] = mesh.positions[mesh.indices[3 * face + k]];
    }
    const std::array<glm::dvec3, 3> edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
    const double longest2 =
        std::max({glm::dot(edges[0], edges[0]), glm::dot(edges[1], edges[1]), glm::dot(edges[2], edges[2])});
    const glm::dvec3 normal = glm::cross(edges[0], edges[1]);
    const double doubled = glm::length(normal);
    if (!(doubled > kLeastHeight * longest2)) continue;
    faces.normals[face] = normal / doubled;
    faces.areas[face] = doubled / 2;
    faces.area += faces.areas[face];
  }
  joinNeighbours(faces);
  return faces;
}

} // namespace parity::bake
