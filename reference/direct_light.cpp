#include "reference/direct_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/reflection.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

namespace f64 = shading::f64;

glm::dvec3 safeNormalize(const glm::dvec3& v, const glm::dvec3& fallback) {
  const f64::real3 n = f64::safeNormalize(f64::real3(v.x, v.y, v.z), f64::real3(fallback.x, fallback.y, fallback.z));
  return {n.x, n.y, n.z};
}

// Illuminance at the point, on a surface facing the light, and the way to it (scenes::Falloff, KHR_lights_punctual's
// cone).
struct Incident {
  glm::dvec3 direction, illuminance;
  double distance;
};
Incident incidentFrom(const scenes::Light& light, const glm::dvec3& position) {
  const glm::dvec3 axis(light.direction), color(light.color);
  if (light.kind == scenes::LightKind::directional) return {-axis, color, std::numeric_limits<double>::infinity()};
  const glm::dvec3 d = glm::dvec3(light.position) - position;
  const glm::dvec3 L = safeNormalize(d, -axis); // at the light itself: as if from its axis
  double attenuation =
      f64::distanceFalloff(static_cast<int>(light.falloff), glm::dot(d, d), light.range, light.falloffExponent);
  if (light.kind == scenes::LightKind::spot)
    attenuation *= f64::spotAttenuation(glm::dot(-L, axis), std::cos(static_cast<double>(light.innerConeAngle)),
                                        std::cos(static_cast<double>(light.outerConeAngle)));
  return {L, color * attenuation, glm::length(d)};
}

} // namespace

DirectLight shadeDirect(const SurfaceSample& sample, const std::vector<scenes::Light>& lights, const Model& model,
                        const DirectionalAlbedo* albedo, const PointVisibility& fromHere) {
  if (lights.empty()) return {};
  const Lobes lobes(sample, model, std::max<double>(sample.roughness, kMinLightRoughness), albedo);
  return shadeDirect(sample, lights, lobes, fromHere);
}

DirectLight shadeDirect(const SurfaceSample& sample, const std::vector<scenes::Light>& lights, const Lobes& lobes,
                        const PointVisibility& fromHere) {
  DirectLight sum;
  if (lights.empty()) return sum;
  const glm::dvec3 N = glm::normalize(glm::dvec3(sample.normal)), V = glm::normalize(glm::dvec3(sample.view));
  const double NoV = std::clamp(glm::dot(N, V), kMinNoV, 1.0);
  // Stretched lobes need vectors, others cosines alone.
  const Frame frame = frameOf(sample, lobes);
  const glm::dvec3 view = visibleView(frame.toLocal(V));
  const LobeView atView = lobes.isStretched() ? lobes.viewAt(view) : lobes.viewAt(NoV);
  const auto evaluate = [&](const glm::dvec3& L) {
    if (lobes.isStretched()) return lobes.evaluate(view, frame.toLocal(L), atView);
    const glm::dvec3 H = safeNormalize(V + L, N); // V = -L: the normal
    return lobes.evaluate(NoV, f64::saturate(glm::dot(N, L)), f64::saturate(glm::dot(N, H)),
                          f64::saturate(glm::dot(V, H)), atView);
  };
  for (const scenes::Light& light : lights) {
    const Incident incident = incidentFrom(light, sample.position);
    const glm::dvec3 image = fromHere.hasHorizon() ? fromHere.mirror(incident.direction) : -N;
    const bool isFront = glm::dot(N, incident.direction) > 0, isFolded = glm::dot(N, image) > 0;
    if (!(isFront || isFolded) || !fromHere.reaches(incident.direction, incident.distance)) continue;
    LobeValues values;
    if (isFront) values = evaluate(incident.direction);
    if (isFolded) values.specular += evaluate(image).specular;
    const bool isSun = light.kind == scenes::LightKind::directional;
    (isSun ? sum.sunDiffuse : sum.localDiffuse) += values.diffuse * incident.illuminance;
    (isSun ? sum.sunSpecular : sum.localSpecular) +=
        values.specular * incident.illuminance * static_cast<double>(light.specularScale);
  }
  return sum;
}

} // namespace parity::reference
