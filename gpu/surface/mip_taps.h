// How a texel of the next mip covers texels of the one before, along one axis.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace parity::gpu {

// At most three source texels, with the shares of the target texel that they cover.
struct Taps {
  int first = 0, count = 1;
  std::array<double, 3> weights{1, 0, 0};
};

inline std::vector<Taps> makeTaps(int source, int target) {
  std::vector<Taps> taps(target);
  for (int i = 0; i < target; ++i) {
    const double begin = static_cast<double>(i) * source / target, end = static_cast<double>(i + 1) * source / target;
    Taps& tap = taps[i];
    tap.first = static_cast<int>(begin);
    tap.count = std::min(static_cast<int>(std::ceil(end)), source) - tap.first;
    for (int k = 0; k < tap.count; ++k)
      tap.weights[k] =
          (std::min<double>(end, tap.first + k + 1) - std::max<double>(begin, tap.first + k)) / (end - begin);
  }
  return taps;
}

} // namespace parity::gpu
