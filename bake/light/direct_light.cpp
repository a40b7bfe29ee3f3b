#include "bake/light/direct_light.h"

#include <cmath>
#include <limits>

#include "shading/shading.h"

namespace parity::bake {

bool addLight(const scenes::Light& light, const SurfacePoint& point, bool bothSides,
              const lighting::Visibility& visibility, LightSum& sum) {
  const glm::dvec3 position(point.position), normal(point.normal);
  glm::dvec3 geometric(point.geometric);
  glm::dvec3 direction = -glm::dvec3(light.direction);
  double attenuation = 1, distance = std::numeric_limits<double>::infinity();
  if (light.kind != scenes::LightKind::directional) {
    const glm::dvec3 way = glm::dvec3(light.position) - position;
    const double d2 = glm::dot(way, way);
    if (!(d2 > 0)) return false; // at the light itself
    distance = std::sqrt(d2);
    direction = way / distance;
    attenuation =
        shading::f64::distanceFalloff(static_cast<int>(light.falloff), d2, light.range, light.falloffExponent);
    if (light.kind == scenes::LightKind::spot)
      attenuation *= shading::f64::spotAttenuation(-glm::dot(direction, glm::dvec3(light.direction)),
                                                   std::cos(light.innerConeAngle), std::cos(light.outerConeAngle));
  }
  const double cosine = glm::dot(normal, direction), side = glm::dot(geometric, direction);
  if (cosine == 0 || side * cosine <= 0) return false; // shading normals tell another side than the surface
  if (side < 0) {
    if (!bothSides) return false;
    geometric = -geometric;
  }
  if (!(attenuation > 0)) return false;
  const glm::dvec3 origin = visibility.leaveSurface(position, geometric);
  if (visibility.isOccluded(origin, direction, distance - 2 * visibility.surfaceOffset(position))) return false;
  sum.add(glm::dvec3(light.color) * attenuation, direction, cosine);
  return true;
}

} // namespace parity::bake
