// A region's weights at coarser scales: what share of each larger pixel belongs to it.
#pragma once

#include "base/image/image.h"
#include "compare/pooling/pixel_view.h"
#include "compare/pooling/region_runs.h"

namespace parity::compare {

class ScaledWeights {
public:
  // At the images' own scale. halvings: how often it may be halved. region: not empty.
  ScaledWeights(const RegionRuns& region, int width, int height, int halvings);

  // Each weight becomes the mean of 2x2; at an odd edge of the image, of those that are in it.
  void halve();

  // plane: 1 channel, of the images' size at this scale, the odd edges rounded up. Weighted mean in double.
  double meanOf(const base::Image& plane) const;

private:
  int m_x, m_y;          // where the weights' box begins, at this scale
  base::Image m_weights; // of the box
};

} // namespace parity::compare
