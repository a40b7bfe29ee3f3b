// The environment as a mobile device holds it: one cube, trilinear, in few bits.
#pragma once

#include <cstddef>
#include <vector>

#include "lighting/environment/environment_light.h"

namespace parity::lighting {

// The first layer of each mip of the prefiltered array, six faces of (faceSize >> m)^2 texels in the cube's order.
struct Capture {
  int faceSize = 0;
  std::vector<std::vector<std::byte>> mips;
};

// RGBA8 that decodes by shading/rgbm.glsl; radiance above 256 saturates.
Capture encodeRgbm(const CubeMap& prefiltered);

// RGB with 9 bits each and one exponent of 5 (VK_FORMAT_E5B9G9R9_UFLOAT_PACK32), decoded by the texture unit before it
// filters, which every Vulkan and OpenGL ES 3.0 device does; radiance above 65408 saturates.
Capture encodeRgb9e5(const CubeMap& prefiltered);

// RGBA16F, A = 1; radiance above 65504 saturates.
Capture encodeHalf(const CubeMap& prefiltered);

} // namespace parity::lighting
