// What a screen shows of a frame, and what becomes of pixels that are not finite.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "job/displayed.h"

namespace parity::job {
namespace {

TEST(Displayed, isTheSrgbEncodedColourInEightBits) {
  base::Image color(3, 1, 3);
  color.pixels = {0, 0, 0, 0.5f, 0.5f, 0.5f, 2, 2, 2};
  const Displayed shown = displayImage(color, base::DisplayTransform("sRGB"), 0);
  EXPECT_EQ(shown.pixels.pixels,
            (std::vector<std::uint8_t>{0, 0, 0, 188, 188, 188, 255, 255, 255})); // 0.5 -> 187.5: IEC 61966-2-1
  EXPECT_EQ(shown.finite.pixels[3], 188 / 255.f);
  EXPECT_EQ(shown.measured, shown.finite);
}

TEST(Displayed, neverShowsANonFinitePixelAsAPlainOne) {
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  base::Image color(2, 1, 3, 0.2f);
  color.pixels[1] = kInf; // would be displayed as a plain 1
  color.pixels[5] = kNan;
  const Displayed shown = displayImage(color, base::DisplayTransform("sRGB"), 0);
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(shown.pixels.pixels[k], 0);
    EXPECT_EQ(shown.finite.pixels[k], 0);
    EXPECT_TRUE(std::isnan(shown.measured.pixels[k]));
  }
  base::Image map(2, 1, 1, 0.f);
  markNonFinite(map, shown.measured);
  EXPECT_EQ(map.pixels, (std::vector<float>{1, 1}));
}

} // namespace
} // namespace parity::job
