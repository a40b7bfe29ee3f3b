#include "bake/atlas/density.h"

#include <algorithm>
#include <cmath>

namespace parity::bake {

namespace {

constexpr double kUsual = 16, kFewest = 1 << 14, kMost = 1 << 20;

double surfaceArea(const scenes::Scene& scene) {
  double area = 0;
  for (const scenes::Instance& instance : scene.instances) {
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].unlit) continue;
    const glm::dmat4 toWorld(instance.toWorld);
    const auto corner = [&](std::size_t i) {
      return glm::dvec3(toWorld * glm::dvec4(mesh.positions[mesh.indices[i]], 1));
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
      area += glm::length(glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i))) / 2;
  }
  return area;
}

} // namespace

double defaultTexelsPerMetre(const scenes::Scene& scene) {
  const double area = surfaceArea(scene);
  if (!(area > 0) || !std::isfinite(area)) return kUsual; // the atlas will say what is wrong
  return std::clamp(kUsual, std::sqrt(kFewest / area), std::sqrt(kMost / area));
}

} // namespace parity::bake
