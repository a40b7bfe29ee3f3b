// How square maps share the layers of one array image.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace parity::gpu {

struct ShadowTile {
  std::uint32_t x = 0, y = 0, layer = 0; // its first texel
};

struct ShadowTiling {
  std::uint32_t side = 1, layers = 1; // of the image
  std::vector<ShadowTile> tiles;      // of each map
};

// sides: of the maps in texels, powers of two; 0: no map, its tile means nothing. Layers are as large as the largest
// map, and at least as kMinLayerSide where the device takes that. Largest first along a Z curve, so that nothing but
// the end of the last layer is left free. Throws Error (exit 4) naming `device` beyond its sides and layers.
ShadowTiling packTiles(std::span<const std::uint32_t> sides, std::uint32_t maxSide, std::uint32_t maxLayers,
                       const std::string& device);
inline constexpr std::uint32_t kMinLayerSide = 2048;

} // namespace parity::gpu
