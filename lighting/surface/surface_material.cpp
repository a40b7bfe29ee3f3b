#include "lighting/surface/surface_material.h"

#include <algorithm>
#include <cmath>

#include "shading/shading.h"

namespace parity::lighting {

namespace {

glm::dvec3 fromSrgb(const glm::dvec4& stored) {
  using shading::f64::srgbToLinear;
  return {srgbToLinear(stored.x), srgbToLinear(stored.y), srgbToLinear(stored.z)};
}

// Of glTF's tangent frame: xyz of the tangent, unit or 0, and the bitangent's sign.
glm::dvec4 tangentAt(const scenes::Instance& instance, const scenes::Mesh& mesh, const TrianglePoint& at, double side) {
  if (mesh.tangents.empty()) return glm::dvec4(0);
  const glm::dmat3 linear{glm::dmat4(instance.toWorld)};
  glm::dvec3 sum(0);
  for (int k = 0; k < 3; ++k) sum += at.weights[k] * glm::dvec3(mesh.tangents[at.vertices[k]]);
  const glm::dvec3 tangent = linear * sum;
  const double length = glm::length(tangent), mirror = glm::determinant(linear) < 0 ? -1 : 1;
  if (!(length > 0) || !std::isfinite(length)) return glm::dvec4(0);
  return {side * tangent / length, mesh.tangents[at.vertices[0]].w * side * mirror};
}

// Any axis at right angles to n (Duff et al. 2017).
glm::dvec3 anyTangent(const glm::dvec3& n) {
  const double s = n.z >= 0 ? 1 : -1, a = -1 / (s + n.z);
  return {1 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x};
}

glm::dvec3 mappedNormal(const scenes::Scene& scene, const scenes::Instance& instance, const Visibility::Hit& hit,
                        const SurfacePoint& point, const TrianglePoint& at) {
  const scenes::Mesh& mesh = scene.meshes[instance.mesh];
  const scenes::Material& material = scene.materials[mesh.material];
  const double side = glm::dot(glm::dvec3(hit.geometric), point.geometric) < 0 ? -1 : 1;
  glm::dvec4 tangent = tangentAt(instance, mesh, at, side);
  if (glm::dot(glm::dvec3(tangent), glm::dvec3(tangent)) < 0.5) tangent = glm::dvec4(anyTangent(point.smooth), 1);
  const glm::dvec3 bitangent = tangent.w * glm::cross(point.smooth, glm::dvec3(tangent));
  const glm::dvec3 texel = glm::dvec3(readTexture(scene, mesh, material.normalTexture, at)) * 2.0 - 1.0;
  const double scale = material.normalScale;
  const glm::dvec3 n = texel.x * scale * glm::dvec3(tangent) + texel.y * scale * bitangent + texel.z * point.smooth;
  const double length2 = glm::dot(n, n);
  return length2 > 0 ? n / std::sqrt(length2) : point.geometric;
}

} // namespace

glm::dvec3 baseColorAt(const scenes::Scene& scene, const scenes::Mesh& mesh, const TrianglePoint& point) {
  const scenes::Material& material = scene.materials[mesh.material];
  glm::dvec3 base(material.baseColor);
  if (!mesh.colors.empty()) {
    glm::dvec3 color(0);
    for (int k = 0; k < 3; ++k) color += point.weights[k] * glm::dvec3(mesh.colors[point.vertices[k]]);
    base *= color;
  }
  if (material.baseColorTexture.present()) base *= fromSrgb(readTexture(scene, mesh, material.baseColorTexture, point));
  return base;
}

double metallicAt(const scenes::Scene& scene, const scenes::Mesh& mesh, const TrianglePoint& point) {
  const scenes::Material& material = scene.materials[mesh.material];
  if (!material.metallicRoughnessTexture.present()) return material.metallic;
  return material.metallic * readTexture(scene, mesh, material.metallicRoughnessTexture, point).z;
}

glm::dvec3 emissiveAt(const scenes::Scene& scene, const scenes::Mesh& mesh, const TrianglePoint& point) {
  const scenes::Material& material = scene.materials[mesh.material];
  glm::dvec3 emitted(material.emissive);
  if (material.emissiveTexture.present())
    emitted *= fromSrgb(readTexture(scene, mesh, material.emissiveTexture, point));
  return emitted;
}

SurfaceMaterial surfaceMaterialAt(const scenes::Scene& scene, const Visibility::Hit& hit, const SurfacePoint& point) {
  const scenes::Instance& instance = scene.instances[hit.instance];
  const scenes::Mesh& mesh = scene.meshes[instance.mesh];
  const scenes::Material& m = scene.materials[mesh.material];
  const TrianglePoint at = trianglePointOf(mesh, hit);
  SurfaceMaterial result;
  result.normal = m.normalTexture.present() ? mappedNormal(scene, instance, hit, point, at) : point.smooth;
  result.baseColor = baseColorAt(scene, mesh, at);
  result.metallic = metallicAt(scene, mesh, at);
  result.roughness = m.roughness;
  if (m.metallicRoughnessTexture.present())
    result.roughness *= readTexture(scene, mesh, m.metallicRoughnessTexture, at).y;
  result.roughness = std::clamp(result.roughness, 0.0, 1.0);
  if (m.occlusionTexture.present())
    result.occlusion = 1 + m.occlusionStrength * (readTexture(scene, mesh, m.occlusionTexture, at).x - 1);
  result.emissive = emissiveAt(scene, mesh, at);
  // KHR_materials_specular: F0 = min(F0(ior) specularColor, 1) specular; F90 = specular.
  const double root = (m.ior - 1.0) / (m.ior + 1.0);
  result.F0 = glm::clamp(root * root * glm::dvec3(m.specularColor), 0.0, 1.0);
  if (m.specularColorTexture.present()) result.F0 *= fromSrgb(readTexture(scene, mesh, m.specularColorTexture, at));
  result.F90 = m.specular;
  if (m.specularTexture.present()) result.F90 *= readTexture(scene, mesh, m.specularTexture, at).w;
  result.F0 *= result.F90;
  return result;
}

} // namespace parity::lighting
