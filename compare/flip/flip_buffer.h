// Memory for the rows of a tile: how wide its parts are, and how they are aligned.
#pragma once

#include <algorithm>
#include <cstddef>

#include <hwy/aligned_allocator.h>

namespace parity::compare {

inline constexpr int kAlignment = 16;   // floats: what the columns of a batch begin at multiples of
inline constexpr int kBlockWidth = 32;  // columns that are filtered or left out together
inline constexpr int kFilteredRows = 5; // of FilteredRow

inline int roundUp(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

using FlipBuffer = hwy::AlignedFreeUniquePtr<float[]>;

inline FlipBuffer allocate(std::size_t count) {
  auto memory = hwy::AllocateAligned<float>(count);
  std::fill_n(memory.get(), count, 0.f); // columns beyond the rows' ends are read, and must be numbers
  return memory;
}

} // namespace parity::compare
