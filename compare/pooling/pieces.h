// How a region is cut into tasks, the same whatever the number of threads, so that sums are too.
#pragma once

#include <cstddef>
#include <vector>

#include "compare/pooling/region_runs.h"

namespace parity::compare {

inline constexpr std::size_t kPiecePixels = 65536; // about; one task

// The run after the piece that begins with run `run`.
inline std::size_t endOfPiece(const RegionRuns& region, std::size_t run) {
  for (std::size_t pixels = 0; run < region.runs.size() && pixels < kPiecePixels; ++run)
    pixels += region.runs[run].count;
  return run;
}

} // namespace parity::compare
