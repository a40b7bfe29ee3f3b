// Exact Euclidean distances over a grid, in linear time.
#pragma once

#include <cstdint>
#include <limits>

#include "base/image/image.h"

namespace parity::bake {

inline constexpr std::int32_t kNoSource = std::numeric_limits<std::int32_t>::max();

// The squared distance, in pixels, from each pixel's middle to that of the nearest source (not 0); kNoSource where
// there is none at all. Exact integers. Meijster, Roerdink and Hesselink 2000, "A general algorithm for computing
// distance transforms in linear time": distances along the columns, then the lower envelope of their parabolas along
// each row. One channel; sides up to base::kMaxImageSide. Parallel, the same for any number of threads.
base::BasicImage<std::int32_t> squaredDistances(const base::Image8& sources);

} // namespace parity::bake
