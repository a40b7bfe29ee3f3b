// Regions of an image: lists of pixels, and where they lie.
#pragma once

#include <span>

#include "base/frame.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// All pixels of an image of that size, weight 1.
base::PixelList wholeImage(int width, int height);

// The smallest box that holds every pixel of the lists and `margin` more on each side, within the image; empty where
// they hold none.
Rect boundsOf(std::span<const base::PixelList* const> lists, int width, int height, int margin = 0);

} // namespace parity::compare
