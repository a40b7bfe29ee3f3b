// The table of the sheen's directional albedo against an integral over the hemisphere in another parametrisation.
#include "highend/sheen_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::highend {
namespace {

namespace f64 = shading::f64;
using std::numbers::pi;

// Midpoints in the polar angle and the azimuth.
double integrate(double roughness, double NoV) {
  constexpr int kPolar = 1500, kAzimuth = 180;
  const double alpha = f64::sheenAlpha(roughness), sinV = std::sqrt(1 - NoV * NoV);
  double sum = 0;
  for (int i = 0; i < kPolar; ++i) {
    const double theta = (i + 0.5) / kPolar * pi / 2, NoL = std::cos(theta), sinL = std::sin(theta);
    const double V = f64::V_Charlie(alpha, NoV, NoL);
    for (int j = 0; j < kAzimuth; ++j) {
      const double VoL = NoV * NoL + sinV * sinL * std::cos(pi * (j + 0.5) / kAzimuth);
      sum += f64::D_Charlie(alpha, std::min((NoV + NoL) / std::sqrt(2 + 2 * VoL), 1.0)) * V * NoL * sinL;
    }
  }
  return sum * (pi / 2 / kPolar) * (2 * pi / kAzimuth);
}

TEST(SheenTable, IsTheIntegralOfTheLobe) {
  constexpr int kSize = 64;
  const base::Image table = makeSheenTable(kSize);
  double worst = 0;
  for (const int y : {0, 6, 13, 25, 40, 63})
    for (const int x : {2, 5, 12, 30, 50, 63}) {
      const double truth = std::min(integrate(y / (kSize - 1.0), x / (kSize - 1.0)), 1.0);
      worst = std::max(worst, std::abs(table.at(x, y)[0] - truth));
    }
  std::printf("worst error of the sheen's table: %.5f\n", worst);
  EXPECT_LE(worst, 1e-3);
}

TEST(SheenTable, IsAShareOfTheLight) {
  const base::Image table = makeSheenTable(128);
  for (const float value : table.pixels) {
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 1);
  }
}

} // namespace
} // namespace parity::highend
