// Dispatch bins and pixel lists from a picture of ids: count, scan, scatter in pixel order, never atomics.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace parity::gpu {

// Entries of one bin share code (material class) and textures; they are consecutive and in pixel order.
struct Bin {
  std::uint32_t key = 0; // the caller's
  std::uint32_t first = 0, count = 0;
};

struct Bins {
  std::vector<Bin> bins;              // ascending by key; none is empty
  std::vector<std::uint32_t> entries; // indices into the picture, bin after bin
};

// ids: a picture of (instance + 1, triangle); 0 = nothing there. keyOfInstance: bin key of each instance, all <
// keyCount. The result does not depend on the number of threads.
Bins makeBins(std::span<const glm::uvec2> ids, std::span<const std::uint32_t> keyOfInstance, std::uint32_t keyCount);

// Reorders the entries within each bin: region by region of kRegionSide x kRegionSide pixels, in it block by block of
// kBlockSide x kBlockSide, all row by row. What a group of invocations works at then lies close together, and so do
// successive groups. width: of the picture.
inline constexpr std::uint32_t kBlockSide = 8, kRegionSide = 32;
void orderByBlocks(Bins& bins, std::uint32_t width);

} // namespace parity::gpu
