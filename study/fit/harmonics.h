// The lobes of GGX and of the prefiltered cube in spherical harmonics: what fits of environment reads compare.
#pragma once

#include <array>
#include <vector>

#include "shading/surface_model.h"

namespace parity::fit {

inline constexpr int kBands = 40;

// Coefficients of what mirrors in a plane: of bands l = 0..kBands, those even in azimuth (m = 0..l), at indexOf(l, m).
using Harmonics = std::vector<double>;
constexpr int indexOf(int l, int m) { return l * (l + 1) / 2 + m; }
inline constexpr int kHarmonics = indexOf(kBands, kBands) + 1;

// Normalised Legendre functions K_lm P_lm(cosTheta), times sqrt 2 for m > 0 (no Condon-Shortley phase). cosTheta in
// [-1, 1].
Harmonics harmonicsAt(double cosTheta);

// Samples of the half vector, polar by azimuth.
struct LobeSteps {
  int polar = 300, azimuth = 200;
};

// The lobe D V NoL of GGX seen at NoV in (0, 1], its mirror direction at azimuth 0, the normal at the pole; integral 1.
Harmonics projectLobe(shading::GeometryTerm term, double roughness, double NoV, const LobeSteps& steps = {});

// By how much a lobe of N = V = R (a texel of the prefiltered cube) of this roughness damps each band: the mean of P_l.
using Zonal = std::array<double, kBands + 1>;
Zonal dampingOf(double roughness);

// Power of natural light in band l, (l + 1/2)^-2.5 but for a factor (Dror, Willsky and Adelson 2004, "Statistical
// characterization of real-world illumination").
double naturalPower(int l);

// Angle from the normal, in the plane of incidence, of mix(N, R, blend); negative beyond the normal.
double angleOfBlend(double NoV, double blend);

} // namespace parity::fit
