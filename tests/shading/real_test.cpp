// The helpers of real.glsl: transfer function, luminance, safe normalisation, saturate.
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

// IEC 61966-2-1:1999, written out.
double decodeByTheStandard(double s) {
  return s <= 0.04045 ? s / 12.92 : std::exp(2.4 * std::log((s + 0.055) / 1.055));
}

TEST(Srgb, DecodesAsTheStandardSays) {
  for (int code = 0; code <= 255; ++code) {
    const double s = code / 255.0;
    EXPECT_NEAR(f64::srgbToLinear(s), decodeByTheStandard(s), 1e-14) << code;
    EXPECT_NEAR(f32::srgbToLinear(static_cast<float>(s)), decodeByTheStandard(s), 3e-7) << code;
  }
  EXPECT_NEAR(f64::srgbToLinear(0.5), 0.21404114048223255, 1e-15); // the standard's formula at 40 digits, rounded
}

TEST(Srgb, EncodingUndoesDecoding) {
  for (int code = 0; code <= 255; ++code) {
    const double s = code / 255.0;
    EXPECT_NEAR(f64::linearToSrgb(f64::srgbToLinear(s)), s, 1e-7); // the standard's two branches meet within that
    EXPECT_EQ(std::lround(f32::linearToSrgb(f32::srgbToLinear(static_cast<float>(s))) * 255), code);
  }
  const f64::real3 encoded = f64::linearToSrgb(f64::srgbToLinear(f64::real3(0.01, 0.5, 1)));
  EXPECT_NEAR(encoded.x, 0.01, 1e-12);
  EXPECT_NEAR(encoded.y, 0.5, 1e-12);
  EXPECT_NEAR(encoded.z, 1, 1e-12);
}

TEST(Luminance, WeighsAsRec709) {
  EXPECT_DOUBLE_EQ(f64::luminance({1, 0, 0}), 0.2126);
  EXPECT_DOUBLE_EQ(f64::luminance({0, 1, 0}), 0.7152);
  EXPECT_DOUBLE_EQ(f64::luminance({0, 0, 1}), 0.0722);
  EXPECT_DOUBLE_EQ(f64::luminance({2, 2, 2}), 2);
}

TEST(SafeNormalize, GivesUnitLengthAtAnyLengthInEveryPrecision) {
  for (const double length : {1e-300, 1e-20, 1.0, 1e20, 1e38}) {
    const f64::real3 n = f64::safeNormalize({length * 1, length * -2, length * 2}, {0, 0, 1});
    EXPECT_NEAR(n.x, 1.0 / 3, 1e-15);
    EXPECT_NEAR(n.y, -2.0 / 3, 1e-15);
  }
  for (const float length : {1e-30f, 1.0f, 1e30f}) {
    const f32::real3 n = f32::safeNormalize({length, -2 * length, 2 * length}, {0, 0, 1});
    EXPECT_NEAR(n.z, 2.0f / 3, 1e-7);
  }
  // docs/shading.md 4: normalize(half3) is bad for lengths <= 4.8e-4 and >= 257; half code normalises in single
  // precision.
  for (const float length : {1e-4f, 257.0f, 1e30f}) {
    const f16::real3 n = f16::narrow(f16::safeNormalize({length, -2 * length, 2 * length}, {}));
    EXPECT_EQ(float(n.x), float(Half(1.0 / 3))) << length;
    EXPECT_EQ(float(n.y), float(Half(-2.0 / 3))) << length;
  }
}

TEST(SafeNormalize, FallsBackForZeroNanAndInfinity) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const f64::real3& v : {f64::real3(0, 0, 0), f64::real3(nan, 1, 1), f64::real3(1, nan, 1), f64::real3(1, 1, nan),
                              f64::real3(inf, 0, 0), f64::real3(0, -inf, 1)}) {
    const f64::real3 n = f64::safeNormalize(v, {0.5, 0.25, 0.125});
    EXPECT_EQ(n.x, 0.5);
    EXPECT_EQ(n.y, 0.25);
    EXPECT_EQ(n.z, 0.125);
  }
}

TEST(Saturate, ClampsToTheUnitInterval) {
  const f64::real3 v = f64::saturate(f64::real3(-1, 0.3, 7));
  EXPECT_EQ(v.x, 0);
  EXPECT_EQ(v.y, 0.3);
  EXPECT_EQ(v.z, 1);
  EXPECT_EQ(f64::sqr(-3), 9);
  EXPECT_EQ(f64::dot3({1, 2, 3}, {4, 5, 6}), 32);
}

} // namespace
} // namespace parity::tests
