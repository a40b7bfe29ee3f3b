// Attenuation of point and spot lights against the text of KHR_lights_punctual and Karis 2013, and their ends.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f32 = shading::f32;
namespace f16 = shading::f16;
using shading::Half;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// KHR_lights_punctual: attenuation = max( min( 1.0 - ( current_distance / range )^4, 1 ), 0 ) / current_distance^2
TEST(SquareFalloff, IsTheExtensionsFormula) {
  for (const double range : {0.5, 3.0, 100.0})
    for (const double d : {0.02, 0.4, 1.0, 2.9, 50.0, 200.0}) {
      const double expected = std::max(std::min(1.0 - std::pow(d / range, 4), 1.0), 0.0) / (d * d);
      EXPECT_NEAR(f64::squareFalloff(d * d, range), expected, 1e-12 * (1 + expected));
    }
}

TEST(SquareFalloff, WithoutRangeIsTheInverseSquare) {
  EXPECT_DOUBLE_EQ(f64::squareFalloff(9, 0), 1.0 / 9);
  EXPECT_DOUBLE_EQ(f64::squareFalloff(9, kInfinity), 1.0 / 9);
  EXPECT_FLOAT_EQ(f32::squareFalloff(9, std::numeric_limits<float>::infinity()), 1.0f / 9);
}

TEST(SquareFalloff, IsFiniteAtTheLightAndZeroAtTheRange) {
  EXPECT_DOUBLE_EQ(f64::squareFalloff(0, 5), 1e4); // 1 / (1 cm)^2
  EXPECT_NEAR(f64::squareFalloff(1e-6, 5), 1e4, 1e-9);
  EXPECT_NEAR(float(f16::squareFalloff(0, 5)), 1e4, 8); // fits in half
  EXPECT_EQ(f64::squareFalloff(25, 5), 0);
  EXPECT_EQ(f64::squareFalloff(26, 5), 0);
}

TEST(SquareFalloff, KeepsDistancesBeyond256MetresInHalfPrecision) {
  EXPECT_NEAR(float(f16::squareFalloff(90000, 0)), 1.0 / 90000, 1e-7); // 300 m: d^2 would be inf in half
  EXPECT_GT(float(f16::squareFalloff(90000, 1000)), 0);
}

// Karis 2013, eq. 9: saturate(1 - (d/r)^4)^2 / (d^2 + 1) in centimetres, so per cm^2.
TEST(SquareFalloffUE4, IsTheCoursesFormulaInMetres) {
  for (const double rangeCm : {50.0, 1000.0})
    for (const double dCm : {0.0, 1.0, 30.0, 400.0, 1001.0}) {
      const double window = std::min(std::max(1 - std::pow(dCm / rangeCm, 4), 0.0), 1.0);
      const double perSquareCm = window * window / (dCm * dCm + 1);
      EXPECT_NEAR(f64::squareFalloffUE4(dCm * dCm * 1e-4, rangeCm * 1e-2), perSquareCm * 1e4, 1e-9);
    }
  EXPECT_NEAR(f64::squareFalloffUE4(4, 0), 1 / (4 + 1e-4), 1e-12);
}

// DynamicLightingCommon.ush: pow(1 - saturate(dot(WorldLightVector, WorldLightVector)), FalloffExponent), the vector in
// units of the radius.
TEST(ExponentFalloff, IsTheEnginesRadialAttenuation) {
  for (const double range : {0.5, 7.0, 300.0})
    for (const double exponent : {0.5, 2.0, 8.0, 16.0})
      for (const double share : {0.0, 0.1, 0.5, 0.99, 1.0, 1.5}) {
        const double normalized = share * share;
        EXPECT_NEAR(f64::exponentFalloff(share * share * range * range, range, exponent),
                    std::pow(1 - std::min(std::max(normalized, 0.0), 1.0), exponent), 1e-12)
            << range << ", " << exponent << ", " << share;
      }
  EXPECT_DOUBLE_EQ(f64::exponentFalloff(4, 4, 2), 0.5625); // half way: (3/4)^2
}

TEST(ExponentFalloff, IsFiniteWhateverTheRange) {
  EXPECT_EQ(f64::exponentFalloff(0, 0, 8), 0);
  EXPECT_EQ(f64::exponentFalloff(1, 0, 8), 0);
  EXPECT_EQ(f64::exponentFalloff(1e30, 1e-3, 8), 0);
  EXPECT_EQ(float(f16::exponentFalloff(250000, 1000, 1)), 0.75f) << "500 m: d^2 would be inf in half";
}

TEST(DistanceFalloff, IsThatOfTheNumber) {
  EXPECT_EQ(f64::distanceFalloff(f64::kFalloffKhr, 4, 3, 8), f64::squareFalloff(4, 3));
  EXPECT_EQ(f64::distanceFalloff(f64::kFalloffUE4, 4, 3, 8), f64::squareFalloffUE4(4, 3));
  EXPECT_EQ(f64::distanceFalloff(f64::kFalloffExponent, 4, 3, 8), f64::exponentFalloff(4, 3, 8));
  EXPECT_GT(f64::squareFalloff(4, 3) / f64::squareFalloffUE4(4, 3), 1.2) << "they differ there";
}

// KHR_lights_punctual, the reference code of "Inner and Outer Cone Angles".
double spotByTheExtension(double cd, double cosInner, double cosOuter) {
  const double lightAngleScale = 1.0 / std::max(0.001, cosInner - cosOuter);
  const double lightAngleOffset = -cosOuter * lightAngleScale;
  const double angularAttenuation = std::min(std::max(cd * lightAngleScale + lightAngleOffset, 0.0), 1.0);
  return angularAttenuation * angularAttenuation;
}

TEST(SpotAttenuation, IsTheExtensionsFormula) {
  for (const double outer : {0.1, 0.5, 1.2})
    for (const double inner : {0.0, 0.05, 0.09})
      for (double angle = 0; angle < 1.6; angle += 0.01)
        EXPECT_NEAR(f64::spotAttenuation(std::cos(angle), std::cos(inner), std::cos(outer)),
                    spotByTheExtension(std::cos(angle), std::cos(inner), std::cos(outer)), 1e-11);
}

TEST(SpotAttenuation, IsOneInsideZeroOutsideAndSquaredBetween) {
  EXPECT_EQ(f64::spotAttenuation(0.95, 0.9, 0.7), 1);
  EXPECT_EQ(f64::spotAttenuation(0.6, 0.9, 0.7), 0);
  EXPECT_NEAR(f64::spotAttenuation(0.8, 0.9, 0.7), 0.25, 1e-12);
}

TEST(SpotAttenuation, StepsWhereInnerEqualsOuter) {
  EXPECT_EQ(f64::spotAttenuation(0.802, 0.8, 0.8), 1);
  EXPECT_EQ(f64::spotAttenuation(0.8, 0.8, 0.8), 0);
  EXPECT_EQ(f32::spotAttenuation(0.79f, 0.8f, 0.8f), 0);
  const Half edge(0.8), inside(0.81);
  EXPECT_EQ(float(f16::spotAttenuation(inside, edge, edge)), 1);
}

TEST(ClampContribution65000, CutsEachChannelOnItsOwn) {
  const f64::real3 c = f64::clampContribution65000({1e6, 65000, 3});
  EXPECT_EQ(c.x, 65000);
  EXPECT_EQ(c.y, 65000);
  EXPECT_EQ(c.z, 3);
}

// docs/shading.md 4: "min(65000, x) stores 64992, and two such lights add up to inf".
TEST(ClampContribution65000, LetsTwoLightsOverflowHalf) {
  const Half huge = Half(65504.0);
  const Half one = f16::clampContribution65000({huge, huge, huge}).x;
  EXPECT_EQ(float(one), 64992);
  EXPECT_TRUE(std::isinf(float(one + one)));
}

} // namespace
} // namespace parity::tests
