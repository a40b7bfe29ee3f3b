// From an equirectangular panorama to the base mip of a cube map, by exact areas.
#pragma once

#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/panorama.h"

namespace parity::lighting {

// Six faces (Vulkan's order) of faceSize^2 texels, RGBA with A = 1. The panorama's texels are cells of constant
// radiance, and a cube texel is the mean over its solid angle: a constant stays what it is, and the energy of a single
// texel is kept to 0.1 % (summed along meridians: exact on the four sides but for rounding). A panorama coarser than
// the faces is interpolated bilinearly first: energy is kept but for its rows next to the poles. faceSize: even. Throws
// as makePanorama does.
std::vector<glm::vec4> resampleEquirect(const scenes::Environment& environment, int faceSize);
// The same of a panorama made for such faces.
std::vector<glm::vec4> resampleEquirect(const Panorama& panorama, int faceSize);
// Of two panoramas that differ in their radiance alone, in little more time than of one.
std::pair<std::vector<glm::vec4>, std::vector<glm::vec4>> resampleEquirect(const Panorama& a, const Panorama& b,
                                                                           int faceSize);

} // namespace parity::lighting
