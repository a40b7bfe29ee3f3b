// The high-end lightmap's halves.
#include "bake/encode/half_encoding.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bake/lightmap_pages.h"

namespace parity::bake {
namespace {

// IEEE 754 binary16, by its definition.
double fromHalf(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
  const double value = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return (bits & 0x8000) != 0 ? -value : value;
}

glm::dvec4 texelAt(const base::BasicImage<std::uint16_t>& halves, int x, int y) {
  const std::uint16_t* p = halves.at(x, y);
  return {fromHalf(p[0]), fromHalf(p[1]), fromHalf(p[2]), fromHalf(p[3])};
}

TEST(HighendEncoding, HoldsIrradianceAndDirectionInTwoHalves) {
  LightmapPage page = makePage(4, 3);
  const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 2, -2));
  setTexel(page, 1, 2, 0, {kTestPi, 2 * kTestPi, 0.001 * kTestPi}, .5, towards * (.5 * std::sqrt(3.0)), {0, 1, 0});
  setTexel(page, 2, 2, 0, glm::dvec3(1e9), 2, glm::dvec3(0, .4, 0), {0, 1, 0});
  setTexel(page, 3, 2, 0, glm::dvec3(0), 0, glm::dvec3(0), {0, 1, 0});
  setTexel(page, 0, 0, 0, glm::dvec3(0), .1, glm::dvec3(7, 0, 0), {0, 1, 0}); // longer than light can make it
  const auto halves = encodeHalves(page);
  ASSERT_EQ(halves.width, 4);
  ASSERT_EQ(halves.height, 6);
  const glm::dvec4 upper = texelAt(halves, 1, 2), lower = texelAt(halves, 1, 5);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(lower[c], towards[c], 0x1p-11);
  EXPECT_NEAR(upper.r, 1, 0x1p-11);
  EXPECT_NEAR(upper.g, 2, 0x1p-10);
  EXPECT_NEAR(upper.b, .001, .001 * 0x1p-11);
  EXPECT_EQ(upper.a, 1);
  EXPECT_EQ(lower.a, 1);
  EXPECT_EQ(texelAt(halves, 2, 2).r, 65504);
  EXPECT_NEAR(texelAt(halves, 2, 5).y, .2 / std::sqrt(3.0), 1e-4);
  EXPECT_EQ(texelAt(halves, 3, 5), glm::dvec4(0, 0, 0, 1));
  EXPECT_EQ(texelAt(halves, 0, 3), glm::dvec4(1, 0, 0, 1));
  EXPECT_EQ(texelAt(halves, 2, 1), glm::dvec4(0, 0, 0, 1)); // without an owner
}

} // namespace
} // namespace parity::bake
