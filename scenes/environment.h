// The steps that make an image file an environment, one by one.
#pragma once

#include <cstddef>
#include <string>

#include "base/image/image.h"
#include "base/image/image_io.h"

namespace parity::scenes {

// The file's picture as radiance is read: R, G, B by their names, or grey (Y) spread, whatever stands beside them;
// turned as its header says (info.orientation); twice as wide as high. `label` is for messages. Throws Error (exit 4)
// for other channels, a cube map, pixels of a part of the panorama alone (the windows of OpenEXR) and any other shape.
base::Image toPanorama(base::ImageFile file, const std::string& label);

// Turned as the orientation says (EXIF 2.3, tag 274: 1, as it is, to 8).
base::Image toUpright(base::Image image, int orientation);

// How many values of an environment were replaced, those that are too small not counted.
struct CleanedCounts {
  std::size_t notANumber = 0, infinite = 0, negative = 0, tooLarge = 0;
};

// So that no product or sum of light overflows: 1e8 times this is still a float.
inline constexpr float kMaxRadiance = 1e30f;
// So that what is left and its products with the weights of filters (1e-8) are no denormal numbers, with which
// processors compute some 20 times as slowly.
inline constexpr float kMinRadiance = 1e-30f;

// NaN, negative values (-infinity too) and what is below kMinRadiance become 0, +infinity the largest finite value of
// the image, and what is above kMaxRadiance that. Throws Error (exit 4) where nothing is finite.
CleanedCounts cleanRadiance(base::Image& radiance, const std::string& label);

} // namespace parity::scenes
