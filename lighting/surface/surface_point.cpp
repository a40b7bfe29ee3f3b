#include "lighting/surface/surface_point.h"

#include <algorithm>
#include <array>

namespace parity::lighting {

namespace {

// Normals are transformed by the cofactors: the inverse transpose but for its scale, of flattened objects, too.
glm::dmat3 normalTransform(const glm::dmat3& linear) {
  const glm::dmat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                             glm::cross(linear[0], linear[1]));
  return glm::determinant(linear) < 0 ? -cofactors : cofactors;
}

glm::dvec3 safeNormal(const glm::dvec3& n, const glm::dvec3& fallback) {
  const double length2 = glm::dot(n, n);
  return length2 > 0 && length2 < 1e300 ? n / std::sqrt(length2) : fallback;
}

} // namespace

TrianglePoint trianglePointOf(const scenes::Mesh& mesh, const Visibility::Hit& hit) {
  const std::size_t first = std::size_t{3} * hit.triangle;
  const double u = hit.barycentric.x, v = hit.barycentric.y;
  return {{mesh.indices[first], mesh.indices[first + 1], mesh.indices[first + 2]}, {1 - u - v, u, v}};
}

SurfacePoint surfacePointAt(const scenes::Scene& scene, const Visibility::Hit& hit, const glm::dvec3& direction) {
  const scenes::Instance& instance = scene.instances[hit.instance];
  const scenes::Mesh& mesh = scene.meshes[instance.mesh];
  const glm::dmat4 toWorld(instance.toWorld);
  const glm::dmat3 normalToWorld = normalTransform(glm::dmat3(toWorld));
  const TrianglePoint at = trianglePointOf(mesh, hit);
  const double side = glm::dot(glm::dvec3(hit.geometric), direction) > 0 ? -1 : 1;
  SurfacePoint point;
  point.geometric = side * glm::dvec3(hit.geometric);
  std::array<glm::dvec3, 3> corners, normals;
  glm::dvec3 local(0);
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec3 normal = mesh.normals.empty() ? glm::dvec3(0) : glm::dvec3(mesh.normals[at.vertices[k]]);
    corners[k] = glm::dvec3(toWorld * glm::dvec4(mesh.positions[at.vertices[k]], 1));
    normals[k] = side * safeNormal(normalToWorld * normal, glm::dvec3(hit.geometric));
    local += at.weights[k] * normal;
    point.position += at.weights[k] * corners[k];
  }
  point.smooth = safeNormal(side * (normalToWorld * local), point.geometric);
  for (std::size_t k = 0; k < 3; ++k)
    point.lift += at.weights[k] * std::max(0.0, glm::dot(corners[k] - point.position, normals[k])) * normals[k];
  return point;
}

} // namespace parity::lighting
