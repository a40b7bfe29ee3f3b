#include "reference/fog.h"

#include <algorithm>

#include "shading/shading.h"

namespace parity::reference {

namespace f64 = shading::f64;

FogBetween fogBetween(const scenes::Fog& fog, const scenes::Camera& camera, const glm::dvec3& place) {
  glm::dvec3 way = place - glm::dvec3(camera.toWorld[3]);
  if (camera.orthographic) {
    const glm::dvec3 direction = -glm::normalize(glm::dvec3(camera.toWorld[2]));
    way = std::max(glm::dot(way, direction), 0.0) * direction;
  }
  const double transmittance =
      f64::heightFogTransmittance({fog.density, fog.heightFalloff, fog.height, fog.startDistance, fog.maxOpacity},
                                  place.y - way.y, way.y, glm::length(way));
  return {glm::dvec3(fog.color) * (1 - transmittance), transmittance};
}

ShadedSample seenThrough(const FogBetween& fog, ShadedSample point) {
  const auto transmittance = static_cast<float>(fog.transmittance);
  glm::vec3 color(0);
  for (glm::vec3& term : point.terms) term *= transmittance;
  point.terms[static_cast<std::size_t>(shading::Term::fog)] = glm::vec3(fog.inscattered);
  for (const glm::vec3& term : point.terms) color += term;
  point.standardError *= transmittance;
  if (point.standardError > 0) point.relativeError = point.standardError / std::max({color.x, color.y, color.z});
  return point;
}

} // namespace parity::reference
