// The mobile lightmap: 8 bits a channel, two halves, and then ASTC, as Unreal Engine 4's mobile renderer stores its
// "low quality" one (docs/shading.md 7a).
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "bake/encode/lightmap_page.h"
#include "base/image/astc.h"
#include "base/image/image.h"

namespace parity::bake {

// What turns the codes of an instance's texels into values: code / 255 * scale + add, channel by channel. Code 0 is the
// instance's least value, exactly; scale is 0 where all are alike.
struct LqScales {
  glm::vec4 colorScale{0}, colorAdd{0};         // of the upper half: LogRGB
  glm::vec4 directionScale{0}, directionAdd{0}; // of the lower half: along y, z and x of the world, and the constant
};

struct LqOptions {
  base::AstcBlock block = base::AstcBlock::astc4x4; // none: the codes as they are
};

// Of decoded irradiance at the page's normals, over channels of owned texels: its difference from the page's, relative
// to the luminance (.3, .59, .11) of the page's + pi 2^-8.
struct LqError {
  double rms = 0, largest = 0;
};

struct LqFigures {
  LqError quantized; // what 8 bits make
  LqError stored;    // what 8 bits and ASTC make
  // Peak signal-to-noise ratio that ASTC leaves the codes of owned texels, red to blue, in dB; infinite where
  // nothing is lost.
  double colorDb = 0, directionDb = 0;
};

struct LqLightmap {
  std::vector<base::Image8> pages; // RGBA, W x 2 H: LogRGB and alpha 255 above, the direction below; decoded again
  std::vector<LqScales> instances; // zeros for one without a texel
  LqFigures figures;               // zeros and infinities where no texel is owned
};

// Every owner is below instanceCount. Texels without one get codes that cost their neighbours in a block least.
LqLightmap encodeLq(const std::vector<LightmapPage>& pages, std::size_t instanceCount, const LqOptions& options);

} // namespace parity::bake
