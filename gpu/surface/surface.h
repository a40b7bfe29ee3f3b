// The surface buffer: one layer of what is seen through a picture's pixels, rasterised once and shaded by every path.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/device/buffer.h"
#include "gpu/surface/bins.h"
#include "gpu/surface/scene_buffers.h"
#include "gpu/surface/view.h"

namespace parity::gpu {

struct Surface {
  std::uint32_t width = 0, height = 0; // of the whole picture
  bool blended = false;                // its opacity lets what lies behind through
  // Per entry, in bin order: pixel index y*width+x in the whole picture, and the instance seen there.
  std::vector<std::uint32_t> pixels, instances;
  // Bin keys index SurfacePass::binKinds() of the pass that made this surface.
  std::vector<Bin> bins;
  Buffer position, normal, tangent, uv, uv0Derivatives, uv1Derivatives, color, fog,
      lightmap; // shaders/surface.glsl; one element where the scene has none
  std::size_t size() const { return pixels.size(); }
};

} // namespace parity::gpu
