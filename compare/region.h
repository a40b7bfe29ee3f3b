// Regions of an image: lists of pixels, where they lie, and the interior of a mask.
#pragma once

#include <span>

#include "base/frame.h"
#include "compare/pixel_view.h"

namespace parity::compare {

// The pixels of `list` (weight > 0) all of whose neighbours in the square window of +-radius lie in `list` too. Pixels
// outside the image do not erode: filters replicate the edge there. Weights and name are kept. Costs O(pixels in the
// list), whatever the size of the image. Throws Error (failed) for a malformed list (compare/region_list.h).
base::PixelList erode(const base::PixelList& list, int width, int height, int radius);

// All pixels of an image of that size, weight 1.
base::PixelList wholeImage(int width, int height);

// The smallest box that holds every pixel of the lists and `margin` more on each side, within the image; empty where
// they hold none.
Rect boundsOf(std::span<const base::PixelList* const> lists, int width, int height, int margin = 0);

} // namespace parity::compare
