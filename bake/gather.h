// Light that arrives at a texel from all that is around it: sky, emitting surfaces, and what others reflect.
#pragma once

#include <cstdint>
#include <span>

#include "bake/reflected_light.h"
#include "bake/texel_light.h"
#include "bake/texels.h"
#include "lighting/emitters.h"
#include "lighting/surface_light.h"
#include "reference/environment_sampler.h"

namespace parity::bake {

// What there is to find. Referenced objects must outlive it.
struct Surroundings {
  const lighting::Visibility& visibility;
  const lighting::SurfaceLight& surfaces;
  const lighting::Emitters& emitters;
  const reference::EnvironmentSampler* sky = nullptr; // null: black
  bool samplesSky = false;                            // it is uneven: sampled by its radiance, too
  const ReflectedLight* reflected = nullptr;          // by fronts; null: nothing is
  const ReflectedLight* reflectedByBacks = nullptr;   // of double-sided surfaces
};

// One texel's points, of which a sample takes any.
struct GatherPoints {
  std::span<const SurfacePoint> points; // at least one
  bool bothSides = false;               // light of the whole sphere about it, for what is seen from behind, too
};

// The estimate of one sample, point `index` of the Owen-scrambled Sobol sequences of this seed: the mean over samples
// is the light of the texel. Directions by a density between the cosine's and a uniform one, so that SH, too, has a
// bounded weight; emitters and an uneven sky are sampled besides, by the balance heuristic (Veach 1997, section 9.2).
// rays: counted up.
LightSum gatherSample(const Surroundings& around, const GatherPoints& texel, std::uint32_t index, std::uint32_t seed,
                      std::uint64_t& rays);

// Whether so uneven that sampling it pays: the standard deviation of its radiance over the sphere is above its mean.
bool isUneven(const reference::EnvironmentSampler& sky);

} // namespace parity::bake
