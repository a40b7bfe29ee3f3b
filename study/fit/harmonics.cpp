// Projections of lobes into spherical harmonics (see harmonics.h).
#include "study/fit/harmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shading/shading.h"

namespace parity::fit {

namespace {

namespace f64 = shading::f64;
using std::numbers::pi;

// The recurrence from band to band, P_(l+1)m = a (cosTheta P_lm - b P_(l-1)m), and along the diagonal.
struct Recurrence {
  std::array<double, kHarmonics> a, b;
  std::array<double, kBands + 1> diagonal;
  Recurrence() {
    for (int m = 0; m <= kBands; ++m) {
      diagonal[m] = m > 0 ? std::sqrt((2 * m + 1.0) / (2.0 * m)) : std::sqrt(1 / (4 * pi));
      for (int l = m; l <= kBands; ++l) {
        const double n = l + 1, square = static_cast<double>(m) * m;
        a[indexOf(l, m)] = std::sqrt((4 * n * n - 1) / (n * n - square));
        b[indexOf(l, m)] = l > m ? std::sqrt((static_cast<double>(l) * l - square) / (4.0 * l * l - 1)) : 0;
      }
    }
  }
};

void fillHarmonics(double cosTheta, Harmonics& y) {
  static const Recurrence recurrence;
  const double sinTheta = std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
  double diagonal = 1;
  for (int m = 0; m <= kBands; ++m) {
    diagonal *= recurrence.diagonal[m] * (m > 0 ? sinTheta : 1);
    double below = 0, at = diagonal * (m > 0 ? std::numbers::sqrt2 : 1);
    for (int l = m; l <= kBands; ++l) {
      const int i = indexOf(l, m);
      y[i] = at;
      const double above = recurrence.a[i] * (cosTheta * at - recurrence.b[i] * below);
      below = at;
      at = above;
    }
  }
}

// The half vectors of GGX at equal shares of D NoH: cos^2 of the angle to the normal.
double cos2Of(double alpha, double share) { return (1 - share) / (1 + (alpha * alpha - 1) * share); }

} // namespace

Harmonics harmonicsAt(double cosTheta) {
  Harmonics y(kHarmonics);
  fillHarmonics(cosTheta, y);
  return y;
}

Harmonics projectLobe(shading::GeometryTerm term, double roughness, double NoV, const LobeSteps& steps) {
  const bool correlated = term == shading::GeometryTerm::heightCorrelated;
  const double alpha = roughness * roughness, sinV = std::sqrt(1 - NoV * NoV);
  Harmonics lobe(kHarmonics, 0.0), y(kHarmonics);
  double total = 0;
  for (int i = 0; i < steps.polar; ++i) {
    const double cos2 = cos2Of(alpha, (i + 0.5) / steps.polar), NoH = std::sqrt(cos2), sinH = std::sqrt(1 - cos2);
    for (int j = 0; j < steps.azimuth; ++j) {
      const double phi = pi * (j + 0.5) / steps.azimuth;
      const double VoH = NoV * NoH - sinV * sinH * std::cos(phi), NoL = 2 * VoH * NoH - NoV;
      if (VoH <= 0 || NoL <= 0) continue;
      const double V = correlated ? f64::V_SmithGGXCorrelated(alpha, NoV, NoL) : f64::V_SchlickSmith(alpha, NoV, NoL);
      const double weight = V * NoL * VoH / NoH;
      const double x = 2 * VoH * sinH * std::cos(phi) + sinV, z = 2 * VoH * sinH * std::sin(phi);
      fillHarmonics(std::min(NoL, 1.0), y);
      const double cosine = std::cos(std::atan2(z, x));
      double previous = weight * cosine, current = weight; // cos((m - 1) azimuth), cos(m azimuth), times the weight
      for (int m = 0; m <= kBands; ++m) {
        for (int l = m; l <= kBands; ++l) lobe[indexOf(l, m)] += y[indexOf(l, m)] * current;
        const double next = 2 * cosine * current - previous;
        previous = current;
        current = next;
      }
      total += weight;
    }
  }
  for (double& c : lobe) c /= total;
  return lobe;
}

Zonal dampingOf(double roughness) {
  constexpr int kSteps = 6000;
  Zonal sum{};
  double total = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double c = 2 * cos2Of(roughness * roughness, (i + 0.5) / kSteps) - 1;
    if (c <= 0) continue;
    double below = 1, at = c;
    sum[0] += c;
    for (int l = 1; l <= kBands; ++l) {
      sum[l] += c * at;
      const double above = ((2 * l + 1) * c * at - l * below) / (l + 1);
      below = at;
      at = above;
    }
    total += c;
  }
  for (double& z : sum) z /= total;
  return sum;
}

double naturalPower(int l) { return std::pow(l + 0.5, -2.5); }

double angleOfBlend(double NoV, double blend) {
  return std::atan2(blend * std::sin(std::acos(NoV)), 1 - blend + blend * NoV);
}

} // namespace parity::fit
