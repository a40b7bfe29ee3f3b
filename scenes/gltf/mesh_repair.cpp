// What a mesh lacks or has wrong, mended on the CPU.
#include "scenes/gltf/mesh_repair.h"

#include <cmath>

#include <fmt/format.h>

namespace parity::scenes {
namespace {

// Twice the area times the normal of triangle `t`; in double, for the tiny models that some exporters make.
glm::dvec3 areaNormal(const Mesh& mesh, std::size_t t) {
  const glm::dvec3 a = mesh.positions[mesh.indices[3 * t]];
  const glm::dvec3 b = mesh.positions[mesh.indices[3 * t + 1]];
  const glm::dvec3 c = mesh.positions[mesh.indices[3 * t + 2]];
  return glm::cross(b - a, c - a);
}

glm::vec3 normalizeOrUp(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0, 1, 0);
}

template <typename T> void spread(std::vector<T>& attribute, const std::vector<std::uint32_t>& indices) {
  if (attribute.empty()) return;
  std::vector<T> corners(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) corners[i] = attribute[indices[i]];
  attribute = std::move(corners);
}

} // namespace

std::vector<std::uint32_t> listFromStrip(const std::vector<std::uint32_t>& strip) {
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i + 2 < strip.size(); ++i)
    list.insert(list.end(), {strip[i], strip[i + 1 + i % 2], strip[i + 2 - i % 2]});
  return list;
}

std::vector<std::uint32_t> listFromFan(const std::vector<std::uint32_t>& fan) {
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i + 2 < fan.size(); ++i) list.insert(list.end(), {fan[i + 1], fan[i + 2], fan[0]});
  return list;
}

void makeFlatNormals(Mesh& mesh) {
  std::vector<glm::vec3> normals(mesh.indices.size());
  for (std::size_t t = 0; 3 * t < mesh.indices.size(); ++t) {
    const glm::vec3 normal = normalizeOrUp(areaNormal(mesh, t));
    for (std::size_t corner = 0; corner < 3; ++corner) normals[3 * t + corner] = normal;
  }
  spread(mesh.positions, mesh.indices);
  spread(mesh.uv0, mesh.indices);
  spread(mesh.uv1, mesh.indices);
  spread(mesh.colors, mesh.indices);
  mesh.normals = std::move(normals);
  mesh.tangents.clear();
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
}

std::string describe(const BrokenDirections& broken, const char* what) {
  const auto number = [&](std::size_t count, bool named) {
    return fmt::format("{}{}{}{}", count, named ? " " : "", named ? what : "", named && count != 1 ? "s" : "");
  };
  std::string text;
  if (broken.zero > 0) text = number(broken.zero, true) + " of length 0";
  if (broken.notFinite > 0)
    text += (text.empty() ? number(broken.notFinite, true) : " and " + number(broken.notFinite, false)) +
            (broken.notFinite == 1 ? " that is NaN or infinite" : " that are NaN or infinite");
  return text;
}

BrokenDirections mendNormals(Mesh& mesh) {
  std::vector<bool> broken(mesh.normals.size());
  BrokenDirections count;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const glm::dvec3 normal = mesh.normals[i];
    const double length = glm::length(normal);
    if (length > 0 && std::isfinite(length))
      mesh.normals[i] = glm::vec3(normal / length);
    else {
      broken[i] = true;
      ++(length == 0 ? count.zero : count.notFinite);
    }
  }
  if (!count.any()) return count;
  std::vector<glm::dvec3> sums(mesh.normals.size(), glm::dvec3(0));
  for (std::size_t t = 0; 3 * t < mesh.indices.size(); ++t) {
    const glm::dvec3 normal = areaNormal(mesh, t);
    for (std::size_t corner = 0; corner < 3; ++corner) sums[mesh.indices[3 * t + corner]] += normal;
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (broken[i]) mesh.normals[i] = normalizeOrUp(sums[i]);
  return count;
}

} // namespace parity::scenes
