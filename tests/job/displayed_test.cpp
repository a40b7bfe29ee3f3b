// What a screen shows of a frame, and what becomes of pixels that are not finite.
#include <gtest/gtest.h>

#include <limits>

#include "job/view/displayed.h"

namespace parity::job {
namespace {

TEST(Displayed, IsTheSrgbEncodedColourInEightBits) {
  base::Image color(3, 1, 3);
  color.pixels = {0, 0, 0, 0.5f, 0.5f, 0.5f, 2, 2, 2};
  const Displayed shown = displayImage(color, base::DisplayTransform("sRGB"), 0);
  EXPECT_EQ(shown.pixels.pixels,
            (std::vector<std::uint8_t>{0, 0, 0, 188, 188, 188, 255, 255, 255})); // 0.5 -> 187.5: IEC 61966-2-1
  EXPECT_TRUE(shown.nonFinite.empty());
}

TEST(Displayed, NeverShowsANonFinitePixelAsAPlainOne) {
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  base::Image color(4, 1, 3, 0.2f);
  color.pixels[1] = kInf; // would be displayed as a plain 1
  color.pixels[5] = kNan;
  color.pixels[11] = 3e38f; // finite until it is exposed
  const Displayed shown = displayImage(color, base::DisplayTransform("sRGB"), 2);
  for (std::size_t k : {0u, 1u, 2u, 3u, 4u, 5u, 9u, 10u, 11u}) EXPECT_EQ(shown.pixels.pixels[k], 0);
  EXPECT_GT(shown.pixels.pixels[6], 0);
  EXPECT_EQ(shown.nonFinite, (std::vector<std::uint32_t>{0, 1, 3}));
}

TEST(Displayed, FindsNonFinitePixelsAllOverALargeFrame) {
  base::Image color(300, 200, 3, 0.2f);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t pixel = 7; pixel < 60000; pixel += 4999) {
    color.pixels[3 * pixel + pixel % 3] = std::numeric_limits<float>::quiet_NaN();
    expected.push_back(pixel);
  }
  EXPECT_EQ(displayImage(color, base::DisplayTransform("raw"), 0).nonFinite, expected);
}

} // namespace
} // namespace parity::job
