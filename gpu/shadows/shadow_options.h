// Knobs of shadow maps, plain data.
#pragma once

#include <cstdint>

namespace parity::gpu {

struct ShadowOptions {
  std::uint32_t mapSize = 2048;          // texels a side of a directional light's map: a power of two, 64..8192
  std::uint32_t filter = 3;              // width of the filter in texels: 0 (one texel, hard), 1, 3, 5 or 7
  std::uint64_t maxBytes = 512ull << 20; // of all maps; they shrink to keep it
  bool operator==(const ShadowOptions&) const = default;
};
inline constexpr std::uint32_t kMinShadowMapSize = 64, kMaxShadowMapSize = 8192;

} // namespace parity::gpu
