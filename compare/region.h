// Regions of an image: the interior of a mask, and the figures over all of it and over the interior.
#pragma once

#include "base/frame.h"
#include "base/image.h"
#include "compare/figures.h"
#include "compare/flip.h"

namespace parity::compare {

// The pixels of `list` (weight > 0) all of whose neighbours in the square window of +-radius lie in `list` too. Pixels
// outside the image do not erode: filters replicate the edge there. Weights and name are kept. Costs O(pixels in the
// list), whatever the size of the image. Throws Error (failed) for a malformed list (see measure()).
base::PixelList erode(const base::PixelList& list, int width, int height, int radius);

// Figures over all pixels of the list, and over the interior: eroded by flipFilterRadius(options), so that no pixel of
// another subject has a part in them. `options` must be those that flipMap was made with. Either may be empty:
// pixels = 0. Throws as measure().
RegionFigures measureRegion(const base::Image& referenceDisplay, const base::Image& testDisplay,
                            const base::Image& flipMap, const base::PixelList& list, const FlipOptions& options = {});

// All pixels of an image of that size, weight 1.
base::PixelList wholeImage(int width, int height);

} // namespace parity::compare
