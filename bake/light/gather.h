// Light that arrives at a texel from all that is around it: sky, emitting surfaces, and what others reflect.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "bake/atlas/texels.h"
#include "bake/light/direction_guide.h"
#include "bake/light/directions.h"
#include "bake/light/reflected_light.h"
#include "bake/light/texel_light.h"
#include "lighting/surface/emitters.h"
#include "lighting/surface/surface_light.h"
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

// Which samples also take a point of an emitter, and of an uneven sky: one of 2^n.
struct GatherShares {
  int emitterSkips = 0, skySkips = 0;
};

// How samples are taken. Referenced objects must outlive it.
struct GatherWay {
  const Directions& directions; // of points that the texel's are among
  const DirectionGuide& guide;
  GatherShares shares = {};
};

struct GatherSample {
  LightSum sum;
  std::optional<double> emitters, sky; // luminance of irradiance that came by these ways, if this sample took them
};

// Point `index` of the Owen-scrambled Sobol sequence of this seed: x and y for a direction, z for a point of the texel.
glm::dvec3 gatherPoint(std::uint32_t index, std::uint32_t seed);

// The estimate of one sample, gatherPoint(index, seed): the mean over samples 0 .. n - 1 is the light of the texel, n a
// multiple of what the shares divide by. Directions by their density times the guide's; emitters and an uneven sky are
// sampled besides. Their weights leave out the guide's density, so it is not needed for them (multiple importance
// sampling, Veach 1997, section 9.2). rays: counted up.
GatherSample gatherSample(const Surroundings& around, const GatherPoints& texel, const GatherWay& way,
                          std::uint32_t index, std::uint32_t seed, std::uint64_t& rays);

// Whether so uneven that sampling it pays: the standard deviation of its radiance over the sphere is above its mean.
bool isUneven(const reference::EnvironmentSampler& sky);

} // namespace parity::bake
