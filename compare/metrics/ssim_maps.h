// The local comparison of SSIM (Wang, Bovik, Sheikh, Simoncelli 2004, "Image quality assessment").
#pragma once

#include "base/image/image.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// SSIM = luminance * structure: l = (2 mx my + C1) / (mx^2 + my^2 + C1) and cs = (2 cov + C2) / (vx + vy + C2)
// (equation 13), of means, variances and covariance under an 11x11 Gaussian of sigma 1.5 whose weights sum to 1,
// C1 = 0.01^2, C2 = 0.03^2 for a range of 1.
struct SsimMaps {
  base::Image ssim;      // l * cs, in [-1,1]
  base::Image structure; // cs, in [-1,1]
};

// reference, test: 1 channel, 0..1, of the same size, finite. Only `box` is computed, the rest is 0; windows see beyond
// it. Beyond the image's edge it is mirrored, the edge's own pixels repeated (... c b a | a b c ...), so that every
// pixel has a value; further than 5 pixels from the edge that is what Wang's own code has. Within 1e-5 of double
// precision; exactly 1 where the windows are identical.
SsimMaps ssimMaps(const base::Image& reference, const base::Image& test, const Rect& box);

} // namespace parity::compare
