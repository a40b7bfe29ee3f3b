// Tangent frames for normal maps, where a file has none.
#include "scenes/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace parity::scenes {
namespace {

// The uv gradient of a triangle. orientation: the sign of its area in uv space; 0 where it has none.
struct FaceTangent {
  glm::dvec3 along{0}; // direction of dP/du, any length
  int orientation = 0;
};

FaceTangent faceTangent(const Mesh& mesh, const std::vector<glm::vec2>& uv, const std::uint32_t* corner) {
  const glm::dvec3 p = mesh.positions[corner[0]];
  const glm::dvec3 e1 = glm::dvec3(mesh.positions[corner[1]]) - p, e2 = glm::dvec3(mesh.positions[corner[2]]) - p;
  const glm::dvec2 w = uv[corner[0]];
  const glm::dvec2 d1 = glm::dvec2(uv[corner[1]]) - w, d2 = glm::dvec2(uv[corner[2]]) - w;
  const double area = d1.x * d2.y - d2.x * d1.y;
  FaceTangent face;
  if (area == 0 || !std::isfinite(area)) return face;
  // dP/du = (e1 d2.y - e2 d1.y) / area (Lengyel 2001); the length is not needed, the sign is.
  face.along = (e1 * d2.y - e2 * d1.y) * (area > 0 ? 1.0 : -1.0);
  face.orientation = glm::dot(face.along, face.along) > 0 ? (area > 0 ? 1 : -1) : 0;
  return face;
}

double angleAt(const Mesh& mesh, std::uint32_t at, std::uint32_t next, std::uint32_t previous) {
  const glm::dvec3 p = mesh.positions[at];
  const glm::dvec3 a = glm::dvec3(mesh.positions[next]) - p, b = glm::dvec3(mesh.positions[previous]) - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)); // stable for slivers, 0 for degenerate ones
}

// Vertices of the same position, normal and uv, bit by bit, share a group: the number of its first vertex.
std::vector<std::uint32_t> groupVertices(const Mesh& mesh, const std::vector<glm::vec2>& uv) {
  struct Key {
    glm::vec3 position, normal;
    glm::vec2 uv;
  };
  static_assert(sizeof(Key) == 8 * sizeof(float));
  const std::size_t count = mesh.positions.size();
  std::vector<Key> keys(count);
  for (std::size_t i = 0; i < count; ++i) keys[i] = {mesh.positions[i], mesh.normals[i], uv[i]};
  std::vector<std::uint32_t> order(count), group(count);
  std::iota(order.begin(), order.end(), 0u);
  const auto compare = [&](std::uint32_t a, std::uint32_t b) { return std::memcmp(&keys[a], &keys[b], sizeof(Key)); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const int difference = compare(a, b);
    return difference ? difference < 0 : a < b;
  });
  for (std::size_t i = 0; i < count; ++i)
    group[order[i]] = i && compare(order[i - 1], order[i]) == 0 ? group[order[i - 1]] : order[i];
  return group;
}

template <typename T> void repeat(std::vector<T>& attribute, std::uint32_t vertex) {
  if (!attribute.empty()) attribute.push_back(T(attribute[vertex]));
}

} // namespace

glm::vec3 perpendicularTo(const glm::vec3& n) {
  const float sign = std::copysign(1.f, n.z);
  const float a = -1.f / (sign + n.z), b = n.x * n.y * a;
  return {1.f + sign * n.x * n.x * a, sign * b, -sign * n.x};
}

std::size_t makeTangents(Mesh& mesh, int texCoord) {
  std::vector<glm::vec2> uv = texCoord == 0 ? mesh.uv0 : mesh.uv1;
  uv.resize(mesh.positions.size());
  const std::vector<std::uint32_t> group = groupVertices(mesh, uv);
  const std::size_t original = mesh.positions.size();

  // Sums per group and orientation: [2 g] for positive, [2 g + 1] for negative uv area.
  std::vector<glm::dvec3> sums(2 * original, glm::dvec3(0));
  std::vector<std::int8_t> orientations(mesh.indices.size() / 3);
  for (std::size_t t = 0; t < orientations.size(); ++t) {
    const std::uint32_t* corner = &mesh.indices[3 * t];
    const FaceTangent face = faceTangent(mesh, uv, corner);
    orientations[t] = static_cast<std::int8_t>(face.orientation);
    if (face.orientation == 0) continue;
    for (int c = 0; c < 3; ++c) {
      const glm::dvec3 normal = mesh.normals[corner[c]];
      const glm::dvec3 inPlane = face.along - normal * glm::dot(normal, face.along);
      const double length = glm::length(inPlane);
      if (length > 1e-9 * glm::length(face.along))
        sums[2 * group[corner[c]] + (face.orientation < 0)] +=
            inPlane / length * angleAt(mesh, corner[c], corner[(c + 1) % 3], corner[(c + 2) % 3]);
    }
  }

  // The first orientation that a vertex meets keeps the vertex; the other one gets a copy.
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> copyOf(original, kNone);
  std::vector<std::int8_t> orientation(original, 0);
  for (std::size_t t = 0; t < orientations.size(); ++t) {
    if (orientations[t] == 0) continue; // degenerate ones take what the vertex has
    for (std::size_t c = 0; c < 3; ++c) {
      std::uint32_t& index = mesh.indices[3 * t + c];
      const std::uint32_t vertex = index;
      if (orientation[vertex] == 0) orientation[vertex] = orientations[t];
      if (orientation[vertex] == orientations[t]) continue;
      if (copyOf[vertex] == kNone) {
        copyOf[vertex] = static_cast<std::uint32_t>(mesh.positions.size());
        repeat(mesh.positions, vertex);
        repeat(mesh.normals, vertex);
        repeat(mesh.uv0, vertex);
        repeat(mesh.uv1, vertex);
        repeat(mesh.colors, vertex);
      }
      index = copyOf[vertex];
    }
  }

  std::size_t fallbacks = 0;
  std::vector<bool> used(mesh.positions.size());
  for (const std::uint32_t index : mesh.indices) used[index] = true;
  mesh.tangents.assign(mesh.positions.size(), glm::vec4(0));
  const auto settle = [&](std::size_t target, std::size_t vertex, bool negative) {
    const glm::dvec3 sum = sums[2 * group[vertex] + negative];
    const double length = glm::length(sum);
    if (length > 1e-9) {
      mesh.tangents[target] = glm::vec4(glm::vec3(sum / length), negative ? 1.f : -1.f);
    } else {
      mesh.tangents[target] = glm::vec4(perpendicularTo(mesh.normals[vertex]), 1.f);
      fallbacks += used[target];
    }
  };
  for (std::size_t v = 0; v < original; ++v) {
    settle(v, v, orientation[v] < 0);
    if (copyOf[v] != kNone) settle(copyOf[v], v, orientation[v] > 0);
  }
  return fallbacks;
}

std::size_t mendTangents(Mesh& mesh) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    glm::vec4& tangent = mesh.tangents[i];
    const float length = glm::length(glm::vec3(tangent));
    const bool usable = length > 0 && std::isfinite(length) && std::isfinite(tangent.w);
    count += !usable;
    tangent = usable ? glm::vec4(glm::vec3(tangent) / length, tangent.w < 0 ? -1.f : 1.f)
                     : glm::vec4(perpendicularTo(mesh.normals[i]), 1.f);
  }
  return count;
}

} // namespace parity::scenes
