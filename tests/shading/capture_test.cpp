// Captures: box parallax against walls found by brute force, weights by their formula and at their ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f32 = shading::f32;

using Vector = std::array<double, 3>;
f64::real32x3 vec(const Vector& v) { return {v[0], v[1], v[2]}; }

// Marches along the ray by bisection between inside and outside of the box: no division by a direction's component.
Vector firstWall(const Vector& from, const Vector& direction, const Vector& lower, const Vector& upper) {
  const auto at = [&](double t) {
    return Vector{from[0] + t * direction[0], from[1] + t * direction[1], from[2] + t * direction[2]};
  };
  const auto isInside = [&](const Vector& p) {
    bool inside = true;
    for (int c = 0; c < 3; ++c) inside &= p[c] >= lower[c] && p[c] <= upper[c];
    return inside;
  };
  double inside = 0, outside = 1000;
  for (int k = 0; k < 200; ++k) (isInside(at((inside + outside) / 2)) ? inside : outside) = (inside + outside) / 2;
  return at(inside);
}

TEST(Capture, ParallaxPointsToWhatTheWallShows) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) { return low + (high - low) * (random() * 0x1p-32); };
  int alongAxes = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector lower = {between(-9, -1), between(-9, -1), between(-9, -1)},
                 upper = {between(1, 9), between(1, 9), between(1, 9)};
    Vector from, origin, direction;
    for (int c = 0; c < 3; ++c) {
      from[c] = between(lower[c], upper[c]);
      origin[c] = between(lower[c] / 2, upper[c] / 2);
      direction[c] = between(-1, 1);
    }
    if (i % 4 == 0) direction[i / 4 % 3] = 0;
    if (i % 8 == 0) direction[(i / 4 + 1) % 3] = 0, ++alongAxes;
    const double length =
        std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    for (double& d : direction) d /= length;
    const Vector wall = firstWall(from, direction, lower, upper);
    Vector expected;
    double norm = 0;
    for (int c = 0; c < 3; ++c) {
      expected[c] = wall[c] - origin[c];
      norm += expected[c] * expected[c];
    }
    for (double& e : expected) e /= std::sqrt(norm);
    const f64::real32x3 actual = f64::boxParallax(vec(from), vec(direction), vec(lower), vec(upper), vec(origin));
    ASSERT_NEAR(actual.x, expected[0], 1e-10) << i;
    ASSERT_NEAR(actual.y, expected[1], 1e-10) << i;
    ASSERT_NEAR(actual.z, expected[2], 1e-10) << i;
    const auto single = [](const Vector& v) { return f32::real32x3{float(v[0]), float(v[1]), float(v[2])}; };
    const f32::real32x3 inSingle =
        f32::boxParallax(single(from), single(direction), single(lower), single(upper), single(origin));
    ASSERT_NEAR(inSingle.x, expected[0], 2e-5) << i;
    ASSERT_NEAR(inSingle.z, expected[2], 2e-5) << i;
  }
  EXPECT_EQ(alongAxes, 250);
}

TEST(Capture, OutsideOfItsBoxAndAtItsOriginNothingIsCorrected) {
  const f64::real32x3 d{0.6, 0, -0.8}, lower{-1, -1, -1}, upper{1, 1, 1};
  const f64::real32x3 outside = f64::boxParallax({1.01, 0, 0}, d, lower, upper, {0, 0, 0});
  EXPECT_EQ(outside.x, d.x);
  EXPECT_EQ(outside.z, d.z);
  const f64::real32x3 origin = f64::boxParallax({0.2, 0.1, 0}, d, lower, upper, {0.2, 0.1, 0});
  EXPECT_NEAR(origin.x, d.x, 1e-12);
  EXPECT_NEAR(origin.y, 0, 1e-12);
  // On a wall, looking out of it, with the origin there too: no direction is left but the one that was asked for.
  const f64::real32x3 corner = f64::boxParallax({1, 0, 0}, {1, 0, 0}, lower, upper, {1, 0, 0});
  EXPECT_EQ(corner.x, 1);
}

TEST(Capture, WeightsFallToNothingAtTheRadiusAndStayFinite) {
  EXPECT_NEAR(f64::captureWeight(1, 4), std::pow((4 - 1) / (4.0 * 1), 2), 1e-12);
  EXPECT_NEAR(f64::captureWeight(2, 3), std::pow((3 - 2) / (3.0 * 2), 2), 1e-12);
  EXPECT_EQ(f64::captureWeight(4, 4), 0);
  EXPECT_EQ(f64::captureWeight(5, 4), 0);
  EXPECT_EQ(f64::captureWeight(1, 0), 0);
  EXPECT_NEAR(f64::captureWeight(2, std::numeric_limits<double>::infinity()), 0.25, 1e-12);
  EXPECT_NEAR(f64::captureWeight(0, 4), 1e6, 1e-3);
  EXPECT_TRUE(std::isfinite(f32::captureWeight(0, 1e-6f)));
}

} // namespace
} // namespace parity::tests
