// The brightest texels of a cube, summed one by one where samples would hit or miss them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/float4.h"

namespace parity::lighting {

struct BrightTexels {
  // Four texels each: x, y, z of their directions; red, green, blue of what they have above the limit times their solid
  // angles. What is left over of the last four is 0.
  struct Four {
    std::array<Float4, 3> direction, energy;
  };
  std::vector<Four> fours;
};

// At most as many texels as this are told apart: in every texel of every mip each costs about a nanosecond.
inline constexpr std::size_t kMaxBrightTexels = 512;

// Takes out of a cube's six faces of n^2 texels what the brightest have above a limit: 20 times the mean luminance, or
// as much as leaves kMaxBrightTexels above it. They keep their colours.
BrightTexels takeBrightTexels(std::vector<glm::vec4>& faces, int n);

// What they add to the radiance filtered by the lobe of N = V: sum energy D(h) NoL / integral D(h) NoL dl, with D of
// GGX at alpha = roughness^2 (Walter et al. 2007, eq. 33) and NoH^2 = (1 + NoL) / 2; texels are points.
// sums: one for each normal; it does not depend on the other normals, nor on the processor.
void sumBrightTexels(const BrightTexels& texels, std::span<const glm::vec3> normals, double roughness,
                     std::span<glm::vec3> sums);

} // namespace parity::lighting
