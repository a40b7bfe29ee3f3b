// Light on its way from surface to surface: what a surface that a ray meets sends back along the ray.
#pragma once

#include <vector>

#include "lighting/surface/emitters.h"
#include "lighting/surface/surface_light.h"
#include "lighting/surface/visibility.h"
#include "reference/environment_sampler.h"
#include "reference/lobes.h"
#include "reference/point_visibility.h"
#include "reference/sampling.h"
#include "scenes/scene.h"

namespace parity::reference {

// What rays find. Referenced objects must outlive it; all are of one scene, whose images have their pixels.
struct Surroundings {
  const lighting::Visibility& visibility;
  const lighting::SurfaceLight& surfaces;
  const lighting::Emitters& emitters;
  const EnvironmentSampler* environment = nullptr; // null or black: none
  const std::vector<scenes::Light>& lights;
  const Model& model;
  const DirectionalAlbedo* albedo = nullptr; // where the model needs one
  bool castsShadows = true;                  // else what rays meet is lit as if it were alone; then for one bounce
};

// Whether a ray sees the surface that it meets: not the back of what has but one side, which is black.
inline bool isSeen(const Surroundings& around, const lighting::Visibility::Hit& hit) {
  return hit.front || around.surfaces.isDoubleSided(hit.instance);
}

// The density, per steradian, with which Emitters::sample comes by the point that a ray met; 0 where it never does.
double emitterPdf(const Surroundings& around, const lighting::Visibility::Hit& hit, const glm::dvec3& direction);

// A point of an emissive surface, seen from another point.
struct EmitterLight {
  glm::dvec3 direction{0.0}; // world, unit
  glm::dvec3 radiance{0.0};
  double pdf = 0; // per steradian
};
// Nothing where it faces away, is cut out or lies behind something.
std::optional<EmitterLight> sampleEmitter(const Surroundings& around, const PointVisibility& fromHere,
                                          const glm::dvec2& u);

// An estimate, by one path, of the radiance that the surface at `hit` reflects back along the ray that met it: all that
// the reference shows there but for emission, with light over at most `bounces` further surfaces. Each surface is lit
// by all lights and, by one direction each of the environment, of the emissive surfaces and of its own lobes, by all
// else, the last three joined by the balance heuristic (Veach and Guibas 1995, eq. 9). Textures are read at
// their base level. A material's occlusion multiplies all but the lights, as for what the eye sees.
glm::dvec3 reflectedRadiance(const Surroundings& around, const lighting::Visibility::Hit& hit,
                             const glm::dvec3& direction, int bounces, PathPoints& points);

} // namespace parity::reference
