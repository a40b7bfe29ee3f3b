// Roughness from averaged normals, against integrals over Gaussian slopes.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;

// The mean of f over a slope along one axis, normally distributed.
double meanOverSlopes(double deviation, const std::function<double(double)>& f) {
  const PanelRule rule({-8, -4, -2, 0, 2, 4, 8}, 24);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = rule.nodes[i];
    sum += rule.weights[i] * std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi) * f(deviation * x);
  }
  return sum;
}

TEST(SpecularAa, LengthOfTheMeanNormalTellsTheVarianceOfSlopes) {
  // |n| = E[1 / sqrt(1 + x^2 + y^2)]: Toksvig's estimate of sigma^2 is exact for small slopes and falls short of wide
  // ones, whose normals are spread less than their slopes.
  const struct { double deviation, tolerance; } cases[] = {{0.01, 0.001}, {0.1, 0.03}, {0.3, 0.2}};
  for (const auto& c : cases) {
    const double length = meanOverSlopes(c.deviation, [&](double x) {
      return meanOverSlopes(c.deviation, [&](double y) { return 1 / std::sqrt(1 + x * x + y * y); });
    });
    const double expected = 2 * c.deviation * c.deviation, grown = f64::alphaSquaredOfNormals(length);
    EXPECT_NEAR(grown, expected, c.tolerance * expected) << c.deviation;
    EXPECT_LT(grown, expected) << c.deviation;
  }
  EXPECT_EQ(f64::alphaSquaredOfNormals(1), 0);
  EXPECT_EQ(f64::alphaSquaredOfNormals(0), 1);
  EXPECT_EQ(float(shading::f16::alphaSquaredOfNormals(shading::Half(0))), 1);
}

// Beckmann's density of slopes along one axis: a Gaussian of variance alpha^2 / 2.
double slopeDensity(double alpha, double slope) {
  return std::exp(-slope * slope / (alpha * alpha)) / (alpha * std::sqrt(std::numbers::pi));
}

TEST(SpecularAa, WidenedLobeIsTheMeanOfLobesOverTheNormals) {
  for (const double roughness : {0.3, 0.5, 0.7})
    for (const double deviation : {0.02, 0.1, 0.25}) {
      const double wider = f64::widenRoughness(roughness, 2 * deviation * deviation);
      for (const double slope : {0.0, 0.1, 0.4}) {
        const double mean =
            meanOverSlopes(deviation, [&](double tilt) { return slopeDensity(roughness * roughness, slope - tilt); });
        EXPECT_NEAR(slopeDensity(wider * wider, slope), mean, 1e-4 * mean + 1e-9)
            << roughness << ' ' << deviation << ' ' << slope;
      }
    }
}

TEST(SpecularAa, RoughnessNeverFallsAndIsUntouchedWithoutVariance) {
  for (int i = 0; i <= 1000; ++i) {
    const float R = static_cast<float>(i) / 1000;
    EXPECT_EQ(shading::f32::widenRoughness(R, 0), R);
    EXPECT_GE(shading::f32::widenRoughness(R, 1e-5f), R);
  }
  EXPECT_EQ(shading::f16::widenRoughness(0.05f, 1e-5f), shading::f32::widenRoughness(0.05f, 1e-5f)) << "not in half";
  EXPECT_EQ(f64::widenRoughness(0, 1), 1);
  EXPECT_EQ(f64::widenRoughness(1, 1), 1);
  EXPECT_DOUBLE_EQ(f64::widenRoughness(0, 0.0625), 0.5);
}

} // namespace
} // namespace parity::tests
