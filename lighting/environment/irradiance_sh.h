// Irradiance by spherical harmonics of order 2.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace parity::lighting {

// The nine irradiance coefficients (cosine kernel applied, the basis of shading/sh.glsl) of a cube of six faces of
// faceSize^2 texels: radiance at the texels' middles times their exact solid angles, summed in double in a fixed order
// (Ramamoorthi and Hanrahan 2001, eq. 10).
std::array<glm::vec3, 9> projectIrradiance(const std::vector<glm::vec4>& faces, int faceSize);

} // namespace parity::lighting
