#include "highend/sheen_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shading/shading.h"

namespace parity::highend {

namespace {

namespace f64 = shading::f64;
using std::numbers::pi;

constexpr int kCosines = 32, kAzimuths = 24;
constexpr double kLeastSheenNoV = 1e-4;

// Of one roughness: the nodes of NoL with their Lambda. NoL = t^2 crowds them at the horizon, where the lobe is bright;
// midpoints of t.
struct SheenNodes {
  double alpha;
  std::array<double, kCosines> NoL{}, weight{}, lambda{};
  std::array<double, kAzimuths> cosine{}; // of midpoints on [0, pi]
  explicit SheenNodes(double roughness) : alpha(f64::sheenAlpha(roughness)) {
    for (int i = 0; i < kCosines; ++i) {
      const double t = (i + 0.5) / kCosines;
      NoL[i] = t * t;
      weight[i] = 2 * t / kCosines;
      lambda[i] = f64::charlieLambda(alpha, NoL[i]);
    }
    for (int i = 0; i < kAzimuths; ++i) cosine[i] = std::cos(pi * (i + 0.5) / kAzimuths);
  }
};

double sheenAlbedoOf(const SheenNodes& nodes, double NoV) {
  const double sinV = std::sqrt(1 - NoV * NoV), lambdaV = f64::charlieLambda(nodes.alpha, NoV);
  double sum = 0;
  for (int i = 0; i < kCosines; ++i) {
    const double NoL = nodes.NoL[i], sinL = std::sqrt(1 - NoL * NoL), NoVL = NoV + NoL;
    double ring = 0;
    for (const double cosine : nodes.cosine) {
      const double VoL = NoV * NoL + sinV * sinL * cosine;
      ring += f64::D_Charlie(nodes.alpha, std::min(NoVL / std::sqrt(2 + 2 * VoL), 1.0));
    }
    sum += ring * nodes.weight[i] / ((1 + lambdaV + nodes.lambda[i]) * 4 * NoV);
  }
  return sum * 2 * pi / kAzimuths;
}

} // namespace

base::Image makeSheenTable(int size) {
  base::Image table(size, size, 1);
  base::parallelFor(static_cast<std::size_t>(size), 1, [&](std::size_t row, std::size_t) {
    const int y = static_cast<int>(row);
    const SheenNodes nodes(y / (size - 1.0));
    for (int x = 0; x < size; ++x)
      table.at(x, y)[0] =
          static_cast<float>(std::min(sheenAlbedoOf(nodes, std::max(x / (size - 1.0), kLeastSheenNoV)), 1.0));
  });
  return table;
}

} // namespace parity::highend
