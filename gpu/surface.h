// The surface buffer: what is seen through a picture's pixels, rasterised once and shaded by every path.
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/bins.h"
#include "gpu/buffer.h"
#include "gpu/scene_buffers.h"
#include "gpu/shaders/interface.h"

namespace parity::gpu {

// A view of width x height pixels. Large pictures are made in bands of whole rows, each a surface of its own, since a
// storage buffer ends at 128 MiB on many devices.
struct Tile {
  std::uint32_t firstRow = 0, rows = 0;
};
inline constexpr std::uint32_t kMaxTilePixels = 1u << 20;
std::vector<Tile> makeTiles(std::uint32_t width, std::uint32_t height);

// Sample positions in a pixel, count >= 1, [0,1)^2: Hammersley points, each in the middle of its stratum; the centre
// for one sample.
std::vector<glm::vec2> samplePositions(int count);

// Which surfaces: the nearest opaque or alpha-masked ones, or the nearest blended ones in front of them.
enum class Layer { opaque, blended };

struct Surface {
  std::uint32_t width = 0, height = 0; // of the whole picture
  // Per entry, in bin order: pixel index y*width+x in the whole picture, and the instance seen there.
  std::vector<std::uint32_t> pixels, instances;
  // Bin keys index SurfacePass::binKinds() of the pass that made this surface.
  std::vector<Bin> bins;
  Buffer position, normal, tangent, uv, uv0Derivatives, uv1Derivatives, color,
      fog; // shaders/surface.glsl; one element where the scene has none
  std::size_t size() const { return pixels.size(); }
};

} // namespace parity::gpu
