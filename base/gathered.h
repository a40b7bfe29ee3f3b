// Gathered images: the values of the pixels of a list, in the list's order.
#pragma once

#include <cstddef>

#include "base/image/image.h"

namespace parity::base {

// Place i of a list is pixel i of its gathered image in row-major order. Rows of this many pixels let loops over rows
// run on all cores; the last row is filled up with 0.
inline constexpr std::size_t kGatheredWidth = 1024;

// For `count` pixels of a list; empty for none.
template <typename T> BasicImage<T> makeGathered(std::size_t count, int channels) {
  if (count == 0) return {};
  const std::size_t width = count < kGatheredWidth ? count : kGatheredWidth;
  return {static_cast<int>(width), static_cast<int>((count + width - 1) / width), channels};
}

} // namespace parity::base
