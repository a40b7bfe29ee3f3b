// Mips made on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/mips.h"

namespace parity::gpu {
namespace {

double toLinear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

TEST(Mips, GoDownToOneTexelByHalves) {
  const auto mips = tests::makeMips(base::Image8(13, 4, 4, 7), false);
  const int sizes[][2] = {{13, 4}, {6, 2}, {3, 1}, {1, 1}};
  ASSERT_EQ(mips.size(), 4u);
  for (std::size_t i = 0; i < mips.size(); ++i) {
    EXPECT_EQ(mips[i].width, sizes[i][0]);
    EXPECT_EQ(mips[i].height, sizes[i][1]);
  }
}

TEST(Mips, OfAConstantImageAreThatConstantInBothEncodings) {
  for (const bool srgb : {false, true})
    for (const int value : {0, 1, 5, 11, 100, 128, 254, 255})
      for (const base::Image8& mip : tests::makeMips(base::Image8(31, 17, 4, static_cast<std::uint8_t>(value)), srgb))
        for (const std::uint8_t v : mip.pixels) ASSERT_EQ(v, value) << (srgb ? "sRGB" : "linear");
}

TEST(Mips, AverageColourInLinearLightAndAlphaAsItIs) {
  base::Image8 image(2, 1, 4);
  image.pixels = {255, 255, 255, 255, 0, 0, 0, 0};
  const base::Image8 mip = tests::makeMips(image, true)[1];
  EXPECT_NEAR(toLinear(mip.pixels[0] / 255.0), 0.5, 0.005); // code 188, not 128
  EXPECT_EQ(mip.pixels[3], 128);
  EXPECT_EQ(tests::makeMips(image, false)[1].pixels[0], 128);
}

TEST(Mips, OfOddSizesKeepTheMean) {
  base::Image8 image(5, 3, 4);
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * 37 % 251);
  for (std::size_t p = 0; p < 15; ++p) sum += image.pixels[4 * p];
  const auto mips = tests::makeMips(image, false);
  // Rounding to 8 bits at each of two levels: at most one code.
  EXPECT_NEAR(mips.back().pixels[0], sum / 15, 1.0);
}

// By the definition: a texel covers the part of the source that lies under it.
double averageUnder(const base::Image8& image, int x, int y, int width, int height, int channel, bool srgb) {
  const auto cover = [](int texel, int index, int from, int to) {
    const double begin = static_cast<double>(index) * from / to, end = static_cast<double>(index + 1) * from / to;
    return std::max(0.0, std::min(end, texel + 1.0) - std::max<double>(begin, texel)) / (end - begin);
  };
  double sum = 0;
  for (int sy = 0; sy < image.height; ++sy)
    for (int sx = 0; sx < image.width; ++sx) {
      const double code = image.at(sx, sy)[channel] / 255.0;
      sum += cover(sx, x, image.width, width) * cover(sy, y, image.height, height) * (srgb ? toLinear(code) : code);
    }
  return sum;
}

TEST(Mips, AreTheAreaWeightedAveragesAtEverySmallSize) {
  for (int width = 1; width <= 9; ++width)
    for (int height = 1; height <= 9; ++height)
      for (const bool srgb : {false, true}) {
        base::Image8 image(width, height, 4);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
          image.pixels[i] = static_cast<std::uint8_t>((i * 7919 + 13) % 256);
        if (width == 1 && height == 1) continue;
        const base::Image8 mip = makeNextMip(image, srgb);
        ASSERT_EQ(mip.width, std::max(width / 2, 1));
        ASSERT_EQ(mip.height, std::max(height / 2, 1));
        for (int y = 0; y < mip.height; ++y)
          for (int x = 0; x < mip.width; ++x)
            for (int c = 0; c < 4; ++c) {
              const double found = mip.at(x, y)[c] / 255.0, half = 0.51 / 255;
              const bool linear = c == 3 || !srgb;
              const double mean = averageUnder(image, x, y, mip.width, mip.height, c, !linear);
              const double lowest = linear ? found - half : toLinear(std::max(found - half, 0.0)),
                           highest = linear ? found + half : toLinear(found + half);
              ASSERT_GE(mean, lowest) << width << " x " << height << " at " << x << ", " << y << " channel " << c;
              ASSERT_LE(mean, highest) << width << " x " << height << " at " << x << ", " << y << " channel " << c;
            }
      }
}

} // namespace
} // namespace parity::gpu
