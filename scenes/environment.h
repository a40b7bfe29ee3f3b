// The steps that make an image file an environment, one by one.
#pragma once

#include <cstddef>
#include <string>

#include "base/image.h"

namespace parity::scenes {

// 1 channel is spread over RGB, of 4 the last is dropped. `label` is for messages. Throws Error (exit 4) for other
// numbers of channels and for an image without pixels.
base::Image toRgb(base::Image image, const std::string& label);

// How many values of an environment were replaced.
struct CleanedCounts {
  std::size_t notANumber = 0, infinite = 0, negative = 0, tooLarge = 0;
};

// So that no product or sum of light overflows: 1e8 times this is still a float.
inline constexpr float kMaxRadiance = 1e30f;

// NaN and negative values (-infinity too) become 0, +infinity the largest finite value of the image, and what is above
// kMaxRadiance that. Throws Error (exit 4) where nothing is finite.
CleanedCounts cleanRadiance(base::Image& radiance, const std::string& label);

} // namespace parity::scenes
