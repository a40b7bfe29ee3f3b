// Pictures for benchmarks.
#pragma once

#include <cstdint>

#include "base/image/image.h"

namespace parity::compare {

// Waves and noise, as a display shows them.
inline base::Image8 makeNoisyImage(int width, int height, unsigned seed) {
  base::Image8 image(width, height, 3);
  unsigned state = seed;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        state = state * 1664525u + 1013904223u;
        const int wave = (x * (c + 1) + 2 * y) / 4 % 400, ramp = wave < 200 ? wave : 400 - wave;
        image.at(x, y)[c] = static_cast<std::uint8_t>(20 + ramp + static_cast<int>(state >> 27));
      }
  return image;
}

} // namespace parity::compare
