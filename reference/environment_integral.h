// The light that one point reflects of an environment, integrated until its error is small enough.
#pragma once

#include <cstdint>

#include "reference/environment_sampler.h"
#include "reference/lobes.h"
#include "reference/point_visibility.h"

namespace parity::reference {

struct IntegralOptions {
  double relativeError = 0.005; // wanted: standard error of the worst channel over the brightest channel's value
  int minSamples = 64;          // for each way of sampling, over all replicates; rounded up to a power of two
  int maxSamples = 1 << 18;
  std::uint32_t seed = 0;
};

struct Integral {
  glm::dvec3 diffuse{0.0}, specular{0.0};
  glm::dvec3 standardError{0.0}; // of their sum, each channel
  int samples = 0;               // for each way of sampling; 0: in closed form
};

// Independent scramblings, whose scatter gives the error.
inline constexpr int kReplicates = 16;

// Without shadows, diffuse light is in closed form (IrradianceSums), and so is what a lobe as wide as the cosine would
// have of light that scatters more than once; a mirror always is. The rest is sampled in two ways - the product of
// environment and lobe, and, where the lobe is narrow, GGX's visible normals - each with the same number of points,
// joined by the balance heuristic (Veach and Guibas 1995, eq. 9). The points are kReplicates independently scrambled
// Sobol sequences, doubled until the error is reached: the estimate is their mean, its standard error comes from their
// scatter (randomised quasi-Monte Carlo; Owen 1997), with kReplicates - 1 degrees of freedom. pixel: picks the
// scramblings. otherLight: what the pixel shows besides, which the relative error counts in. view, normal as in the
// sample; a normal turned away from the eye has the lobe of the last visible direction. Occlusion is not applied.
// fromHere: of the sample; where things cast shadows, every direction is tested, a mirror's too. besides: of other
// light, that which the lobe is one layer of: the more there is, the coarser the product's blocks. weight: what the
// channels are shown at, of which the error is measured; otherLight has its weight.
Integral integrateEnvironment(const SurfaceSample& sample, const Lobes& lobes, const EnvironmentSampler& environment,
                              const glm::dvec3& otherLight, const IntegralOptions& options,
                              const PointVisibility& fromHere = {}, const glm::dvec3& besides = glm::dvec3(0.0),
                              const glm::dvec3& weight = glm::dvec3(1.0));

} // namespace parity::reference
