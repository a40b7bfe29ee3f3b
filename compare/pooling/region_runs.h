// A region as runs of neighbouring pixels: what pooling walks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"

namespace parity::compare {

// Neighbouring pixels of one row of the image.
struct Run {
  std::uint32_t first = 0, count = 0; // pixel indices y*width+x
  std::uint32_t weightAt = 0;         // where the weight of `first` stands
};

// The pixels of weight > 0, in ascending order. Refers to the weights of the list it was made of.
struct RegionRuns {
  std::vector<Run> runs;          // none ends where the next one begins, unless rows or weights part them
  std::span<const float> weights; // empty: all 1
  std::uint64_t pixels = 0;
  double weight = 0; // of all its pixels

  const float* weightsOf(const Run& run) const { return weights.empty() ? nullptr : weights.data() + run.weightAt; }
};

// `list` must outlive the result. Throws Error (failed) for a malformed list (compare/pooling/region_list.h).
RegionRuns runsOf(const base::PixelList& list, int width, int height);

} // namespace parity::compare
