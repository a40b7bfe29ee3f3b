#include "bake/surface_light.h"

#include <algorithm>

#include "lighting/alpha_mask.h"
#include "shading/shading.h"

namespace parity::bake {

namespace {

lighting::TrianglePoint pointOf(const scenes::Mesh& mesh, const lighting::Visibility::Hit& hit) {
  const std::size_t first = std::size_t{3} * hit.triangle;
  const double u = hit.barycentric.x, v = hit.barycentric.y;
  return {{mesh.indices[first], mesh.indices[first + 1], mesh.indices[first + 2]}, {1 - u - v, u, v}};
}

glm::dvec3 fromSrgb(const glm::dvec4& stored) {
  using shading::f64::srgbToLinear;
  return {srgbToLinear(stored.x), srgbToLinear(stored.y), srgbToLinear(stored.z)};
}

} // namespace

SurfaceLight::SurfaceLight(const scenes::Scene& scene) : m_scene(scene) {
  for (const scenes::Material& m : scene.materials)
    m_emits.push_back(!m.unlit && std::max({m.emissive.x, m.emissive.y, m.emissive.z}) > 0);
}

glm::dvec3 SurfaceLight::albedo(const lighting::Visibility::Hit& hit) const {
  const scenes::Mesh& mesh = m_scene.meshes[m_scene.instances[hit.instance].mesh];
  const scenes::Material& material = m_scene.materials[mesh.material];
  const lighting::TrianglePoint point = pointOf(mesh, hit);
  glm::dvec3 base(material.baseColor);
  if (!mesh.colors.empty()) {
    glm::dvec3 color(0);
    for (int k = 0; k < 3; ++k) color += point.weights[k] * glm::dvec3(mesh.colors[point.vertices[k]]);
    base *= color;
  }
  if (material.baseColorTexture.present())
    base *= fromSrgb(lighting::readTexture(m_scene, mesh, material.baseColorTexture, point));
  double metallic = material.metallic;
  if (material.metallicRoughnessTexture.present())
    metallic *= lighting::readTexture(m_scene, mesh, material.metallicRoughnessTexture, point).z;
  return glm::clamp(base * (1 - glm::clamp(metallic, 0.0, 1.0)), 0.0, 1.0);
}

bool SurfaceLight::isHole(const lighting::Visibility::Hit& hit) const {
  const scenes::Mesh& mesh = m_scene.meshes[m_scene.instances[hit.instance].mesh];
  if (m_scene.materials[mesh.material].alphaMode != scenes::AlphaMode::mask) return false;
  const lighting::TrianglePoint point = pointOf(mesh, hit);
  return lighting::isHole(m_scene, mesh, point.vertices, point.weights);
}

glm::dvec3 SurfaceLight::emission(const lighting::Visibility::Hit& hit) const {
  if (!emits(hit.instance)) return glm::dvec3(0);
  const scenes::Mesh& mesh = m_scene.meshes[m_scene.instances[hit.instance].mesh];
  const scenes::Material& material = m_scene.materials[mesh.material];
  glm::dvec3 emitted(material.emissive);
  if (material.emissiveTexture.present())
    emitted *= fromSrgb(lighting::readTexture(m_scene, mesh, material.emissiveTexture, pointOf(mesh, hit)));
  return emitted;
}

} // namespace parity::bake
