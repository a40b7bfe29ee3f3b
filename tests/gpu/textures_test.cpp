// Mips made on the CPU.
#include <gtest/gtest.h>

#include <cmath>

#include "gpu/textures.h"

namespace parity::gpu {
namespace {

double toLinear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

TEST(Mips, goDownToOneTexelByHalves) {
  const auto mips = makeMips(base::Image8(13, 4, 4, 7), false);
  const int sizes[][2] = {{13, 4}, {6, 2}, {3, 1}, {1, 1}};
  ASSERT_EQ(mips.size(), 4u);
  for (std::size_t i = 0; i < mips.size(); ++i) {
    EXPECT_EQ(mips[i].width, sizes[i][0]);
    EXPECT_EQ(mips[i].height, sizes[i][1]);
  }
}

TEST(Mips, ofAConstantImageAreThatConstantInBothEncodings) {
  for (const bool srgb : {false, true})
    for (const int value : {0, 1, 5, 11, 100, 128, 254, 255})
      for (const base::Image8& mip : makeMips(base::Image8(31, 17, 4, static_cast<std::uint8_t>(value)), srgb))
        for (const std::uint8_t v : mip.pixels) ASSERT_EQ(v, value) << (srgb ? "sRGB" : "linear");
}

TEST(Mips, averageColourInLinearLightAndAlphaAsItIs) {
  base::Image8 image(2, 1, 4);
  image.pixels = {255, 255, 255, 255, 0, 0, 0, 0};
  const base::Image8 mip = makeMips(image, true)[1];
  EXPECT_NEAR(toLinear(mip.pixels[0] / 255.0), 0.5, 0.005); // code 188, not 128
  EXPECT_EQ(mip.pixels[3], 128);
  EXPECT_EQ(makeMips(image, false)[1].pixels[0], 128);
}

TEST(Mips, ofOddSizesKeepTheMean) {
  base::Image8 image(5, 3, 4);
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * 37 % 251);
  for (std::size_t p = 0; p < 15; ++p) sum += image.pixels[4 * p];
  const auto mips = makeMips(image, false);
  // Rounding to 8 bits at each of two levels: at most one code.
  EXPECT_NEAR(mips.back().pixels[0], sum / 15, 1.0);
}

} // namespace
} // namespace parity::gpu
