// What the tables of albedos are made and read with: Gauss and Legendre's rule, and cubic interpolation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace parity::reference {

struct QuadratureRule {
  std::vector<double> x, weight;
};

// Gauss and Legendre's rule on [0, 1] (Press et al., Numerical Recipes, section 4.6).
inline QuadratureRule makeGaussRule(int n) {
  QuadratureRule rule;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), derivative = 1;
    for (int step = 0; step < 20; ++step) {
      double p0 = 1, p1 = x;
      for (int k = 2; k <= n; ++k) p0 = std::exchange(p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k);
      derivative = n * (x * p1 - p0) / (x * x - 1);
      x -= p1 / derivative;
    }
    rule.x.push_back(0.5 * (1 - x));
    rule.weight.push_back(1 / ((1 - x * x) * derivative * derivative));
  }
  return rule;
}

// Lagrange's weights of the four nodes from `first` on.
struct Stencil {
  int first;
  std::array<double, 4> weight;
};
// For position x in units of nodes, of which there are `nodes`.
inline Stencil makeStencil(double x, int nodes) {
  const int first = std::clamp(static_cast<int>(x) - 1, 0, nodes - 4);
  const double t = x - first;
  return {first,
          {(t - 1) * (t - 2) * (t - 3) / -6, t * (t - 2) * (t - 3) / 2, t * (t - 1) * (t - 3) / -2,
           t * (t - 1) * (t - 2) / 6}};
}

} // namespace parity::reference
