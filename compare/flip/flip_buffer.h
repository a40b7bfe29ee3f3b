// Memory for the rows of a tile: how wide its parts are, and how they are aligned.
#pragma once

#include <algorithm>
#include <cstddef>

#include <hwy/aligned_allocator.h>

#include "compare/flip/flip_simd.h"

namespace parity::compare {

inline constexpr int kAlignment = 16;  // floats: what the columns of a batch begin at multiples of
inline constexpr int kBlockWidth = 16; // columns that are filtered or left out together

// Filtered columns are made and compared so many at a time that they stay in the first-level cache.
inline constexpr int kChunkColumns = 16;
inline constexpr std::size_t kChunkValues = kChunkColumns * kBatchRows;
inline constexpr int kFilteredPlaneCount = 5; // of FilteredColumns

inline int roundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

using FlipBuffer = hwy::AlignedFreeUniquePtr<float[]>;

inline FlipBuffer allocate(std::size_t count) {
  auto memory = hwy::AllocateAligned<float>(count);
  std::fill_n(memory.get(), count, 0.f); // columns beyond the rows' ends are read, and must be numbers
  return memory;
}

// Planes that lie `size` values apart, from `at` on.
inline FilteredColumns filteredColumnsAt(float* at, std::size_t size) {
  return {at, at + size, at + 2 * size, at + 3 * size, at + 4 * size};
}

} // namespace parity::compare
