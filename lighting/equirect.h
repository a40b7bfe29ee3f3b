// From an equirectangular panorama to the base mip of a cube map, by exact areas.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::lighting {

// The azimuth atan2(z, x), in radians, in the panorama of what is seen at azimuth `a` in the world: the environment is
// turned by +rotationDeg about +Y (right-handed: +Z goes to +X at 90 degrees), as glm::rotate does.
double panoramaAzimuth(double a, float rotationDeg);

// Six faces (Vulkan's order) of faceSize^2 texels, RGBA with A = 1. The panorama's texels are cells of constant
// radiance, and a cube texel is the mean over its solid angle: a constant stays what it is, and the energy of a single
// texel is kept to 0.1 % (summed along meridians: exact on the four sides but for rounding). A panorama coarser than
// the faces is interpolated bilinearly first: energy is kept but for its rows next to the poles. faceSize: even. Throws
// base::Error (exit 4) where the radiance is empty, has not 3 channels, or holds a value that is negative or not
// finite. Values above 1e30 are taken as 1e30, so that no sum overflows.
std::vector<glm::vec4> resampleEquirect(const scenes::Environment& environment, int faceSize);

} // namespace parity::lighting
