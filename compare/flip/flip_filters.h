// FLIP's filter kernels: the contrast sensitivity functions and the feature detectors, in pixels.
#pragma once

#include <vector>

namespace parity::compare {

// Halves of 1D kernels: entry k is the weight at +k and, by symmetry (antisymmetry for `edge`), of -k.
struct FlipFilters {
  int radius = 0; // of the widest kernel
  // Contrast sensitivity (Andersson 2020, eq. 3 and table 1): each a*sqrt(pi/b)*exp(-pi^2 x^2/b), x in degrees. Y and
  // Cx sum to 1 and are cut where the rest weighs less than 1e-7; Cz is the sum of two separable Gaussians.
  std::vector<float> luma, redGreen, blueYellowA, blueYellowB;
  // Features (section 4.3): Gaussian of sigma = half of 0.082 degrees, and its first and second derivative, their
  // positive and negative weights scaled to +-1. Of equal length, and not shorter than luma.
  std::vector<float> gauss, edge, point;
};

// ppd: pixels per degree, 1..1000.
FlipFilters makeFlipFilters(float ppd);

// ceil(3 sqrt(0.04/(2 pi^2)) ppd): three standard deviations of the widest kernel (0.04 is its b).
int colorFilterRadius(float ppd);

} // namespace parity::compare
