// What a scene's surfaces do to light: emit it, and reflect it diffusely.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "lighting/surface/visibility.h"
#include "scenes/scene.h"

namespace parity::lighting {

// Read at a point, without a footprint: averages of many points are right. Linear Rec.709.
class SurfaceLight {
public:
  // The scene must outlive it and keep its images' pixels.
  explicit SurfaceLight(const scenes::Scene& scene);

  // Diffuse albedo, BaseColor (1 - Metallic), in [0, 1]. What metals reflect is no diffuse light.
  glm::dvec3 albedo(const Visibility::Hit& hit) const;
  // Emitted radiance.
  glm::dvec3 emission(const Visibility::Hit& hit) const;
  // Whether the point is cut out of a masked material.
  bool isHole(const Visibility::Hit& hit) const;
  bool emits(std::uint32_t instance) const { return m_emits[materialOf(instance)]; }
  bool isDoubleSided(std::uint32_t instance) const { return m_scene.materials[materialOf(instance)].doubleSided; }

private:
  const scenes::Mesh& meshOf(const Visibility::Hit& hit) const {
    return m_scene.meshes[m_scene.instances[hit.instance].mesh];
  }
  std::uint32_t materialOf(std::uint32_t instance) const {
    return m_scene.meshes[m_scene.instances[instance].mesh].material;
  }
  const scenes::Scene& m_scene;
  std::vector<bool> m_emits; // of each material
};

} // namespace parity::lighting
