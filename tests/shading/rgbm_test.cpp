// RGBM: what 8 bits keep of a capture's radiance.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f32 = shading::f32;

float stored(float value) { return std::floor(value * 255 + 0.5f) / 255; }

// Through 8 bits and back.
f32::real3 roundTrip(const f32::real3& radiance) {
  const f32::Rgbm m = f32::encodeRgbm(radiance);
  return f32::decodeRgbm({stored(m.r), stored(m.g), stored(m.b)}, stored(m.a));
}

TEST(Rgbm, DecodesToTheSquareOfRgbTimesAlphaTimesSixteen) {
  const f32::real3 radiance = f32::decodeRgbm({1, 0.5f, 0}, 0.25f);
  EXPECT_EQ(radiance.x, 16);
  EXPECT_EQ(radiance.y, 4);
  EXPECT_EQ(radiance.z, 0);
}

// docs/shading.md 7c: "8-bit error .4 % rms", here over greys of a uniform logarithm from 2^-4 to 2^8 and tinted
// colours.
TEST(Rgbm, Loses04PercentRmsInEightBits) {
  double sum = 0, worst = 0;
  int count = 0;
  for (double exponent = -4; exponent <= 8; exponent += 1.0 / 512) {
    const auto L = static_cast<float>(std::exp2(exponent));
    const f32::real3 back = roundTrip({L, 0.7f * L, 0.4f * L});
    for (const double e : {back.x / L - 1.0, back.y / (0.7 * L) - 1, back.z / (0.4 * L) - 1}) {
      sum += e * e;
      worst = std::max(worst, std::abs(e));
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(sum / count), 0.004, 0.0015);
  EXPECT_LT(worst, 0.025);
}

TEST(Rgbm, SaturatesAt256AndKeepsBlackBlack) {
  const f32::real3 sun = roundTrip({65504, 256, 0});
  EXPECT_EQ(sun.x, 256);
  EXPECT_EQ(sun.y, 256);
  EXPECT_EQ(sun.z, 0);
  const f32::real3 black = roundTrip({0, 0, 0});
  EXPECT_EQ(black.x + black.y + black.z, 0);
  const f32::Rgbm m = f32::encodeRgbm({0, 0, 0});
  EXPECT_GT(m.a, 0) << "nothing is divided by 0";
  EXPECT_EQ(roundTrip({-1, 0, 4}).x, 0);
}

TEST(Rgbm, CodesStayInTheUnitInterval) {
  for (double exponent = -20; exponent <= 16; exponent += 0.01) {
    const auto L = static_cast<float>(std::exp2(exponent));
    const f32::Rgbm m = f32::encodeRgbm({L, 0.3f * L, 0});
    for (const float code : {m.r, m.g, m.b, m.a}) {
      EXPECT_GE(code, 0) << L;
      EXPECT_LE(code, 1) << L;
    }
  }
}

} // namespace
} // namespace parity::tests
