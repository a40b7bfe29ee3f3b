// GGX prefiltering of a cube map for N = V = R.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "lighting/cube_sampler.h"

namespace parity::lighting {

// One direction of the lobe around N = +Z in tangent space, and the mip that it reads.
struct LobeSample {
  glm::vec3 direction{0.f}; // unit, z > 0
  float weight = 0;         // of the radiance; all weights sum to 1
  int level = 0;            // reads this mip
  float blend = 0;          // and as much of the next
};

// count samples of the lobe D_GGX(alpha, NoH) NoL with N = V (Karis 2013, "PrefilterEnvMap"), alpha = roughness^2, and
// for each the mip whose texels are as large as the solid angle that the sample stands for (Krivanek and Colbert 2008,
// "Real-time Shading with Filtered Importance Sampling", eq. 10). faceSize, levelCount: of the cube that is read.
std::vector<LobeSample> makeLobeSamples(double roughness, int count, int faceSize, int levelCount);

// Six faces of size^2 texels, filtered by these samples around each texel's direction; A = 1.
std::vector<glm::vec4> prefilterMip(const CubeSampler& cube, const std::vector<LobeSample>& samples, int size);

} // namespace parity::lighting
