// The sheen of Estevez and Kulla 2017 as KHR_materials_sheen prints it, without anything of shading/.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::tests {

class SheenFormula {
public:
  explicit SheenFormula(double roughness) : m_alpha(std::pow(std::max(roughness, 0.07), 2)) {}

  double D(double NoH) const {
    const double sine = std::sqrt(std::max(1 - NoH * NoH, 0.0));
    return (2 + 1 / m_alpha) * std::pow(sine, 1 / m_alpha) / (2 * std::numbers::pi);
  }
  double lambda(double cosine) const {
    return cosine < 0.5 ? std::exp(L(cosine)) : std::exp(2 * L(0.5) - L(1 - cosine));
  }
  double V(double NoV, double NoL) const { return 1 / ((1 + lambda(NoV) + lambda(NoL)) * (4 * NoV * NoL)); }

private:
  double L(double x) const {
    const double mix = (1 - m_alpha) * (1 - m_alpha);
    const auto between = [&](double rough, double smooth) { return rough + mix * (smooth - rough); };
    return between(21.5473, 25.3245) / (1 + between(3.82987, 3.32435) * std::pow(x, between(0.19823, 0.16801))) +
           between(-1.97760, -1.27393) * x + between(-4.32054, -4.85967);
  }
  double m_alpha;
};

// The integral by the midpoint rule; the cosine as a cube, so that grazing light has its share of points.
inline double sheenAlbedoBySum(double roughness, double NoV, int steps) {
  const SheenFormula sheen(roughness);
  const double sinV = std::sqrt(1 - NoV * NoV);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double root = (i + 0.5) / steps, NoL = root * root * root, sinL = std::sqrt(1 - NoL * NoL);
    double around = 0;
    for (int j = 0; j < steps; ++j) { // crowded about the mirror direction, where D has a notch
      const double rest = 1 - (j + 0.5) / steps, phi = std::numbers::pi * (1 - rest * rest * rest);
      const double VoL = sinV * sinL * std::cos(phi) + NoV * NoL;
      around += 2 * std::numbers::pi * 3 * rest * rest / steps * sheen.D((NoV + NoL) / std::sqrt(2 + 2 * VoL));
    }
    sum += 3 * root * root / steps * sheen.V(NoV, NoL) * NoL * around;
  }
  return sum;
}

} // namespace parity::tests
