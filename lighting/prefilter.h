// GGX prefiltering of a cube map for N = V = R.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "lighting/cube_sampler.h"

namespace parity::lighting {

// `count` samples of the lobe around N = V = +Z: half vectors by D_GGX at alpha = roughness^2 (Walter et al. 2007,
// eq. 35) in Hammersley's sequence, weights NoL (Karis 2013, "PrefilterEnvMap") that sum to 1. Each reads a footprint
// of the solid angle that it stands for, 1 / (count pdf) (Krivanek and Colbert 2008, "Real-time Shading with Filtered
// Importance Sampling", eq. 10), widened a little so that neighbours overlap. count: a power of two; faceSize: of the
// cube that is read.
std::vector<WeightedRead> makeLobeSamples(double roughness, int count, int faceSize);

// How many samples mip `mip` >= 1 takes: sampleCount times 1, 2, 4, 16, 64. The mips shrink to a quarter each while
// their lobes widen, so the rough ones, where a few samples would miss a small bright light, can have more and yet cost
// no more than a quarter of mip 1.
int samplesOfMip(int mip, int sampleCount);

// Six faces of size^2 texels, each the sum of these samples around its direction; A = 1.
std::vector<glm::vec4> prefilterMip(const CubeSampler& cube, const std::vector<WeightedRead>& samples, int size);

} // namespace parity::lighting
