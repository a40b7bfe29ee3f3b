// Irradiance at every normal, as exact as a cube's bilinear reading shows it.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::lighting {

// 384 KiB in 32-bit floats. Bilinear reading is off by 0.004 to 0.011 % (rms, relative) of six real maps, by 0.14 % of
// a map whose light is one texel, where the terminator's kink is all there is.
inline constexpr int kIrradianceFaceSize = 64;

// Six faces (Vulkan's order) of kIrradianceFaceSize^2 texels: irradiance over pi (the radiance that a white Lambertian
// sends out, linear Rec.709) at the normals of the texels' middles, A = 1, fitted to bilinear reading as the
// prefiltered mips are. Sums are of light vectors (Gershun 1936, "The Light Field"): a patch of the sky that stands
// wholly above the horizon gives n . integral L(w) w dw, whatever is in it. Patches are at most 1.4 degrees wide; one
// that the horizon cuts counts max(0, n . its light vector).
//
// Of a panorama, by its own cells. Throws as makePanorama does.
std::vector<glm::vec4> makeIrradianceCube(const scenes::Environment& environment);
// Of a cube's six faces of faceSize^2 texels, by texels.
std::vector<glm::vec4> makeIrradianceCube(const std::vector<glm::vec4>& faces, int faceSize);

} // namespace parity::lighting
