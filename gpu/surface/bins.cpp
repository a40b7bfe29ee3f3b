#include "gpu/surface/bins.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"

namespace parity::gpu {

Bins makeBins(std::span<const glm::uvec2> ids, std::span<const std::uint32_t> keyOfInstance, std::uint32_t keyCount) {
  constexpr std::size_t kChunk = 16384;
  const std::size_t chunks = (ids.size() + kChunk - 1) / kChunk;
  // counts[chunk * keyCount + key], then, after the scan over (key, chunk), the place of the chunk's first entry.
  std::vector<std::uint32_t> counts(chunks * keyCount, 0);
  base::parallelFor(ids.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* count = counts.data() + begin / kChunk * keyCount;
    for (std::size_t i = begin; i < end; ++i)
      if (ids[i].x != 0) ++count[keyOfInstance[ids[i].x - 1]];
  });
  Bins result;
  std::uint32_t total = 0;
  for (std::uint32_t key = 0; key < keyCount; ++key) {
    const std::uint32_t first = total;
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      std::uint32_t& count = counts[chunk * keyCount + key];
      const std::uint32_t place = total;
      total += count;
      count = place;
    }
    if (total > first) result.bins.push_back({key, first, total - first});
  }
  result.entries.resize(total);
  base::parallelFor(ids.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    std::uint32_t* place = counts.data() + begin / kChunk * keyCount;
    for (std::size_t i = begin; i < end; ++i)
      if (ids[i].x != 0) result.entries[place[keyOfInstance[ids[i].x - 1]]++] = static_cast<std::uint32_t>(i);
  });
  return result;
}

void orderByBlocks(Bins& bins, std::uint32_t width) {
  constexpr std::uint32_t kBlocks = kRegionSide / kBlockSide; // a side of a region
  const auto bandOf = [&](std::uint32_t pixel) { return pixel / width / kRegionSide; };
  const auto blockOf = [&](std::uint32_t pixel) { // in the order of its band
    const std::uint32_t x = pixel % width / kBlockSide, y = pixel / width / kBlockSide % kBlocks;
    return x / kBlocks * kBlocks * kBlocks + y * kBlocks + x % kBlocks;
  };
  std::vector<std::uint32_t> next((width / kRegionSide + 1) * kBlocks * kBlocks + 1), band;
  for (const Bin& bin : bins.bins)
    for (std::uint32_t begin = bin.first, end = begin; begin < bin.first + bin.count; begin = end) {
      while (end < bin.first + bin.count && bandOf(bins.entries[end]) == bandOf(bins.entries[begin])) ++end;
      band.assign(bins.entries.begin() + begin, bins.entries.begin() + end);
      std::fill(next.begin(), next.end(), 0u);
      for (const std::uint32_t pixel : band) ++next[blockOf(pixel) + 1];
      std::partial_sum(next.begin(), next.end(), next.begin());
      for (const std::uint32_t pixel : band) bins.entries[begin + next[blockOf(pixel)]++] = pixel;
    }
}

} // namespace parity::gpu
