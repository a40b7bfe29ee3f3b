// Where a picture lies against the one that it should lie on: by its edges, and put right by resampling.
//
// Pixels are counted from the centre of the picture, x to the right and y down, so that no number depends on a corner.
#pragma once

#include "base/image/image.h"

namespace parity::external {

// A point p of the view is found at shift + scale * rotation * p in the picture. mirrored: x is turned first.
struct Placement {
  double dx = 0, dy = 0; // pixels
  double scale = 1;
  double rotationDeg = 0; // clockwise as it is seen
  bool mirrored = false;
};

struct Shift {
  double dx = 0, dy = 0; // pixels by which the picture's edges lie to the right of the other's, and below them
  // How alike the edges are once they lie on one another: correlation of the edges' strength, -1 to 1.
  double likeness = 0;
};

// Phase correlation of edges (Kuglin and Hines 1975; the peak between the pixels by a DFT of its surroundings, Guizar-
// Sicairos et al. 2008). Both pictures: one channel, the same size, at least 16 x 16. Finds shifts of up to a quarter
// of the picture.
Shift findShift(const base::Image& picture, const base::Image& other);

// Correlation of two pictures of one channel, -1 to 1.
double likenessOf(const base::Image& a, const base::Image& b);

// How far the placement moves the pixel that it moves most, in pixels of a picture of that size.
double mostMoved(const Placement& placement, int width, int height);

// Strength of the edges of a picture: the length of its gradient (Scharr 2000), of the logarithm of luminance, so that
// bright and dark parts count alike. rgb: linear, 3 channels. Returns one channel.
base::Image edgesOf(const base::Image& rgb);

// The picture as it would lie on the view: Lanczos' kernel of three lobes, within the values of the four pixels around
// so that nothing rings. Pixels from beyond the edge are the edge's.
base::Image placedOnView(const base::Image& picture, const Placement& placement);

} // namespace parity::external
