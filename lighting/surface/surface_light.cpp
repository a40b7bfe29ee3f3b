#include "lighting/surface/surface_light.h"

#include <algorithm>

#include "lighting/surface/alpha_mask.h"
#include "lighting/surface/surface_material.h"

namespace parity::lighting {

SurfaceLight::SurfaceLight(const scenes::Scene& scene) : m_scene(scene) {
  for (const scenes::Material& m : scene.materials)
    m_emits.push_back(!m.unlit && std::max({m.emissive.x, m.emissive.y, m.emissive.z}) > 0);
}

glm::dvec3 SurfaceLight::albedo(const Visibility::Hit& hit) const {
  const scenes::Mesh& mesh = meshOf(hit);
  const TrianglePoint point = trianglePointOf(mesh, hit);
  const double metallic = glm::clamp(metallicAt(m_scene, mesh, point), 0.0, 1.0);
  return glm::clamp(baseColorAt(m_scene, mesh, point) * (1 - metallic), 0.0, 1.0);
}

bool SurfaceLight::isHole(const Visibility::Hit& hit) const {
  const scenes::Mesh& mesh = meshOf(hit);
  if (m_scene.materials[mesh.material].alphaMode != scenes::AlphaMode::mask) return false;
  const TrianglePoint point = trianglePointOf(mesh, hit);
  return lighting::isHole(m_scene, mesh, point.vertices, point.weights);
}

glm::dvec3 SurfaceLight::emission(const Visibility::Hit& hit) const {
  if (!emits(hit.instance)) return glm::dvec3(0);
  const scenes::Mesh& mesh = meshOf(hit);
  return emissiveAt(m_scene, mesh, trianglePointOf(mesh, hit));
}

} // namespace parity::lighting
