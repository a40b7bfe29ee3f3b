// What a scene can say about itself: bounds, triangle count, the reflectance of a material.
#include "scenes/scene.h"

#include <algorithm>
#include <limits>

namespace parity::scenes {

// KHR_materials_volume: -ln(attenuationColor) / attenuationDistance (Beer and Lambert). Finite, so that none of it is
// left over a distance of 0.
glm::vec3 Material::absorption() const {
  if (!(attenuationDistance > 0)) return glm::vec3(0);
  constexpr float kLeast = 1e-6f; // of a colour: black would absorb infinitely much
  constexpr float kMost = 1e30f;  // 1 / metre, over distances near 0
  return glm::min(-glm::log(glm::max(attenuationColor, glm::vec3(kLeast))) / attenuationDistance, glm::vec3(kMost));
}

// F0 of a dielectric against air: ((ior-1)/(ior+1))^2 (Fresnel at normal incidence), tinted and scaled as
// KHR_materials_specular says: min(f0 * specularColor, 1) * specular. In double, so that the default ior of 1.5 rounds
// to the very 0.04f that the nonmetal permutation stands for.
glm::vec3 Material::dielectricF0() const {
  const double root = (static_cast<double>(ior) - 1.0) / (static_cast<double>(ior) + 1.0);
  glm::vec3 f0;
  for (int i = 0; i < 3; ++i)
    f0[i] = static_cast<float>(std::clamp(root * root * specularColor[i], 0.0, 1.0) * std::clamp(specular, 0.f, 1.f));
  return f0;
}

bool Material::isNonmetal() const {
  // A texture only ever scales the factor: metallic 0 stays 0. Specular textures could lower F0 below 0.04, specular
  // F90.
  return metallic == 0.f && specular >= 1.f && !specularTexture.present() && !specularColorTexture.present() &&
         dielectricF0() == glm::vec3(0.04f);
}

namespace {

constexpr Bounds kNowhere{glm::vec3(std::numeric_limits<float>::infinity()),
                          glm::vec3(-std::numeric_limits<float>::infinity())};

void extend(Bounds& bounds, const Instance& instance, const Mesh& mesh) {
  const glm::vec3 x(instance.toWorld[0]), y(instance.toWorld[1]), z(instance.toWorld[2]), origin(instance.toWorld[3]);
  std::vector<bool> isDone(mesh.positions.size());
  for (const std::uint32_t index : mesh.indices) { // not over positions: a vertex that no triangle uses is not seen
    if (isDone[index]) continue;
    isDone[index] = true;
    const glm::vec3& at = mesh.positions[index];
    const glm::vec3 p = (x * at.x + y * at.y) + (z * at.z + origin); // the sums of toWorld * at, in their order
    bounds.lower = glm::min(bounds.lower, p);
    bounds.upper = glm::max(bounds.upper, p);
  }
}

Bounds orEmpty(const Bounds& bounds) { return bounds.lower.x <= bounds.upper.x ? bounds : Bounds{}; }

} // namespace

bool Scene::hasLobes() const {
  return std::ranges::any_of(meshes, [&](const Mesh& mesh) { return materials[mesh.material].hasLobes(); });
}

Bounds Scene::boundsOf(std::size_t instance) const {
  Bounds bounds = kNowhere;
  extend(bounds, instances[instance], meshes[instances[instance].mesh]);
  return orEmpty(bounds);
}

Bounds Scene::bounds() const {
  Bounds bounds = kNowhere;
  for (const Instance& instance : instances) extend(bounds, instance, meshes[instance.mesh]);
  return orEmpty(bounds);
}

std::size_t Scene::triangleCount() const {
  std::size_t count = 0;
  for (const Instance& instance : instances) count += meshes[instance.mesh].indices.size() / 3;
  return count;
}

} // namespace parity::scenes
