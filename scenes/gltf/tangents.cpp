// Tangent frames for normal maps and anisotropy, where a file has none.
#include "scenes/gltf/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scenes/gltf/corner_lists.h"
#include "scenes/gltf/mikktspace.h"

namespace parity::scenes {
namespace {

int compare(const glm::vec4& a, const glm::vec4& b) { return std::memcmp(&a, &b, sizeof(glm::vec4)); }

template <typename T> void repeat(std::vector<T>& attribute, std::size_t vertex) {
  if (!attribute.empty()) attribute.push_back(T(attribute[vertex]));
}

// Appends a copy of a vertex; returns its number.
std::uint32_t repeatVertex(Mesh& mesh, std::size_t vertex) {
  repeat(mesh.positions, vertex);
  repeat(mesh.normals, vertex);
  repeat(mesh.tangents, vertex);
  repeat(mesh.uv0, vertex);
  repeat(mesh.uv1, vertex);
  repeat(mesh.colors, vertex);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void reserve(Mesh& mesh, std::size_t vertices) {
  const auto each = [&](auto& attribute) {
    if (!attribute.empty()) attribute.reserve(vertices);
  };
  each(mesh.positions);
  each(mesh.normals);
  each(mesh.uv0);
  each(mesh.uv1);
  each(mesh.colors);
  mesh.tangents.reserve(vertices);
}

} // namespace

glm::vec3 perpendicularTo(const glm::vec3& n) {
  const float sign = std::copysign(1.f, n.z);
  const float a = -1.f / (sign + n.z), b = n.x * n.y * a;
  return {1.f + sign * n.x * n.x * a, sign * b, -sign * n.x};
}

std::size_t makeTangents(Mesh& mesh, int texCoord, const std::function<void(std::size_t)>& beforeGrowth) {
  std::vector<glm::vec2> none;
  const std::vector<glm::vec2>& given = texCoord == 0 ? mesh.uv0 : mesh.uv1;
  if (given.empty()) none.resize(mesh.positions.size());
  const std::vector<glm::vec4> tangentAt =
      makeCornerTangents({mesh.positions, mesh.normals, given.empty() ? none : given, mesh.indices});
  const auto differ = [&](std::uint32_t a, std::uint32_t b) { return compare(tangentAt[a], tangentAt[b]) != 0; };

  const std::size_t original = mesh.positions.size();
  const CornerLists lists(mesh.indices, original);
  std::vector<std::uint32_t> corners;
  // By value: which tangent stays at the vertex must not depend on the order of the triangles.
  const auto sortCorners = [&](std::size_t v) {
    corners.assign(lists.at(v).begin(), lists.at(v).end());
    if (std::adjacent_find(corners.begin(), corners.end(), differ) == corners.end()) return false;
    std::sort(corners.begin(), corners.end(),
              [&](std::uint32_t a, std::uint32_t b) { return compare(tangentAt[a], tangentAt[b]) < 0; });
    return true;
  };
  std::size_t splits = 0;
  for (std::size_t v = 0; v < original; ++v)
    if (sortCorners(v))
      for (std::size_t i = 1; i < corners.size(); ++i) splits += differ(corners[i - 1], corners[i]);
  if (beforeGrowth) beforeGrowth(splits);
  reserve(mesh, original + splits);

  std::size_t fallbacks = 0;
  mesh.tangents.assign(original, glm::vec4(0));
  for (std::size_t v = 0; v < original; ++v) {
    sortCorners(v);
    std::uint32_t target = static_cast<std::uint32_t>(v);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (i > 0 && differ(corners[i - 1], corners[i])) target = repeatVertex(mesh, v);
      mesh.tangents[target] = tangentAt[corners[i]];
      mesh.indices[corners[i]] = target;
    }
    if (mesh.tangents[v].w == 0) { // then it is so at all of its corners, if there are any
      mesh.tangents[v] = glm::vec4(perpendicularTo(mesh.normals[v]), 1.f);
      fallbacks += !corners.empty();
    }
  }
  return fallbacks;
}

std::size_t bytesToMakeTangents(const Mesh& mesh) {
  // Of a corner: its vertex, its places in two lists, its tangent; where its triangle has no direction in uv, its edge
  // and a vote; and of the corners at the vertex in work, which may be all: group, sum, contribution, tangent, two
  // links. Of a vertex: its class, the table of classes, the begins of two lists.
  return mesh.indices.size() * ((4 + 2 * 4 + 16) + (12 + 16) + (4 + 32 + 32 + 16 + 2 * 16)) +
         mesh.positions.size() * (4 + 16 + 2 * 8);
}

BrokenDirections mendTangents(Mesh& mesh) {
  BrokenDirections count;
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    glm::vec4& tangent = mesh.tangents[i];
    const float length = glm::length(glm::vec3(tangent));
    const bool usable = length > 0 && std::isfinite(length) && std::isfinite(tangent.w);
    if (!usable) ++(length == 0 && std::isfinite(tangent.w) ? count.zero : count.notFinite);
    tangent = usable ? glm::vec4(glm::vec3(tangent) / length, tangent.w < 0 ? -1.f : 1.f)
                     : glm::vec4(perpendicularTo(mesh.normals[i]), 1.f);
  }
  return count;
}

} // namespace parity::scenes
