// The spread of normals in the mips of normal maps.
#include "gpu/surface/normal_variance.h"
#include "support/mips.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parity::gpu {
namespace {

base::Image8 makeMap(int width, int height, const std::function<std::array<std::uint8_t, 3>(int, int)>& texel) {
  base::Image8 image(width, height, 4, 99);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto rgb = texel(x, y);
      std::copy(rgb.begin(), rgb.end(), image.at(x, y));
    }
  return image;
}

void writeNormalVariance(std::vector<base::Image8>& mips) {
  mips[0] = withoutVariance(std::move(mips[0]));
  NormalVariance variance;
  for (std::size_t level = 1; level < mips.size(); ++level) variance.writeNext(mips[level - 1], mips[level]);
}

TEST(NormalVariance, OfEqualNormalsIsExactlyZeroAtEveryLevelOfEverySize) {
  const std::array<std::uint8_t, 3> normals[] = {
      {128, 128, 255}, {127, 127, 254}, {200, 90, 201}, {0, 0, 0}, {127, 128, 127}};
  for (const auto& normal : normals)
    for (const auto& [width, height] :
         {std::pair(64, 64), std::pair(1023, 37), std::pair(1, 511), std::pair(700, 333)}) {
      auto mips = tests::makeMips(makeMap(width, height, [&](int, int) { return normal; }), false);
      writeNormalVariance(mips);
      for (const base::Image8& mip : mips)
        for (std::size_t t = 0; t < mip.pixelCount(); ++t) ASSERT_EQ(mip.pixels[4 * t + 3], 0) << mip.width;
    }
}

// Two directions, 2 a apart, in equal shares: |n| = cos a, so alpha^2 grows by 2 (1 - cos a) / cos a.
TEST(NormalVariance, OfTwoDirectionsIsToksvigsFromTheCosineBetweenThem) {
  for (const int code : {140, 170, 200}) {
    auto mips = tests::makeMips(makeMap(16, 16,
                                        [&](int x, int y) {
                                          const auto tilted =
                                              static_cast<std::uint8_t>((x + y) % 2 == 0 ? code : 255 - code);
                                          return std::array<std::uint8_t, 3>{tilted, 127, 220};
                                        }),
                                false);
    const auto before = mips;
    writeNormalVariance(mips);
    const double x = code / 127.5 - 1, yz = std::hypot(127 / 127.5 - 1, 220 / 127.5 - 1),
                 cosine = yz / std::hypot(x, yz);
    const double root = std::sqrt(2 * (1 - cosine) / cosine);
    for (std::size_t level = 0; level < mips.size(); ++level)
      for (std::size_t t = 0; t < mips[level].pixelCount(); ++t) {
        EXPECT_NEAR(mips[level].pixels[4 * t + 3], level == 0 ? 0 : 255 * root, level == 0 ? 0 : 0.51) << code;
        for (int c = 0; c < 3; ++c) ASSERT_EQ(mips[level].pixels[4 * t + c], before[level].pixels[4 * t + c]);
      }
  }
}

// Opposite normals cancel; odd sizes weigh texels by what a mip's texel covers of them.
TEST(NormalVariance, IsOneWhereNormalsCancelAndWeighsByArea) {
  auto opposite = tests::makeMips(makeMap(2, 1,
                                          [](int x, int) {
                                            return std::array<std::uint8_t, 3>{std::uint8_t(x ? 255 : 0), 128, 128};
                                          }),
                                  false);
  writeNormalVariance(opposite);
  EXPECT_EQ(opposite[1].pixels[3], 255);
  auto third = tests::makeMips(
      makeMap(
          3, 1,
          [](int x, int) {
            return std::array<std::uint8_t, 3>{std::uint8_t(x == 1 ? 255 : 128), 128, std::uint8_t(x == 1 ? 128 : 255)};
          }),
      false);
  writeNormalVariance(third);
  const double length = std::hypot(1.0, 2.0) / 3; // two of (0, 0, 1), one of (1, 0, 0)
  EXPECT_NEAR(third[1].pixels[3], 255 * std::sqrt(2 * (1 - length) / length), 2);
}

} // namespace
} // namespace parity::gpu
