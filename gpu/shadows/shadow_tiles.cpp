#include "gpu/shadows/shadow_tiles.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include <fmt/format.h>

#include "base/error.h"

namespace parity::gpu {

namespace {

// Every other bit, from bit 0.
std::uint32_t evenBits(std::uint64_t code) {
  std::uint32_t bits = 0;
  for (unsigned k = 0; k < 32; ++k) bits |= static_cast<std::uint32_t>(code >> (2 * k) & 1) << k;
  return bits;
}

} // namespace

ShadowTiling packTiles(std::span<const std::uint32_t> sides, std::uint32_t maxSide, std::uint32_t maxLayers,
                       const std::string& device) {
  std::vector<std::size_t> order(sides.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sides[a] > sides[b]; });
  std::uint64_t texels = 0;
  for (const std::uint32_t side : sides) texels += std::uint64_t{side} * side;
  ShadowTiling tiling;
  tiling.tiles.resize(sides.size());
  if (texels == 0) return tiling;

  const std::uint32_t largest = sides[order.front()];
  if (largest > maxSide)
    throw base::Error(base::ExitCode::failed, device, fmt::format("shadow map of {0}x{0}", largest),
                      fmt::format("the device allows at most {} texels a side", maxSide));
  // A few small maps need no large layer.
  std::uint32_t side = largest;
  while (side < kMinLayerSide && 2 * side <= maxSide && std::uint64_t{side} * side < texels) side *= 2;
  tiling.side = side;
  const std::uint64_t area = std::uint64_t{side} * side;
  std::uint64_t next = 0; // texels before it are taken: a multiple of the tile's, as sides only fall
  for (const std::size_t k : order) {
    if (sides[k] == 0) break;
    const std::uint64_t tile = std::uint64_t{sides[k]} * sides[k], place = next % area / tile;
    tiling.tiles[k] = {evenBits(place) * sides[k], evenBits(place >> 1) * sides[k],
                       static_cast<std::uint32_t>(next / area)};
    next += tile;
  }
  const std::uint64_t layers = (next + area - 1) / area;
  if (layers > maxLayers)
    throw base::Error(base::ExitCode::failed, device,
                      fmt::format("shadow maps in {} layers of {}x{}", layers, side, side),
                      fmt::format("the device allows at most {} layers", maxLayers));
  tiling.layers = static_cast<std::uint32_t>(layers);
  return tiling;
}

} // namespace parity::gpu
