// The magma colour map against matplotlib's published one.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/error.h"
#include "compare/flip/magma.h"

namespace parity::compare {
namespace {

// matplotlib 3.6, cm.magma.colors: (0.001462, 0.000466, 0.013866), (0.716387, 0.214982, 0.475290), (0.987053, 0.991438,
// 0.749504).
TEST(Magma, EndsAndMiddleAreThePublishedColors) {
  EXPECT_EQ(magmaColor(0), (std::array<std::uint8_t, 3>{0, 0, 4}));
  EXPECT_EQ(magmaColor(128), (std::array<std::uint8_t, 3>{183, 55, 121}));
  EXPECT_EQ(magmaColor(255), (std::array<std::uint8_t, 3>{252, 253, 191}));
}

// Over all 256 entries of matplotlib's table, each value times 255 and rounded: the sums of red, green and blue.
TEST(Magma, AllEntriesAddUpToThePublishedTables) {
  std::array<int, 3> sum{};
  for (int i = 0; i < 256; ++i)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += magmaColor(i)[c];
  EXPECT_EQ(sum, (std::array<int, 3>{41031, 21146, 27942}));
}

// The map is made to be perceptually even: lightness rises throughout, in steps of at most 2 of 255.
TEST(Magma, GetsBrighterFromEntryToEntry) {
  const auto luma = [](int i) {
    const auto c = magmaColor(i);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  for (int i = 1; i < 256; ++i) {
    EXPECT_GT(luma(i), luma(i - 1) - 0.5) << i; // rounding to 8 bit
    EXPECT_LT(luma(i), luma(i - 1) + 2) << i;
  }
}

TEST(Magma, ValuesTakeTheNearestEntryAndAreClamped) {
  base::Image map(6, 1, 1);
  map.pixels = {0.f, 1.f, -2.f, 3.f, 0.4999f / 255.f, 127.5f / 255.f};
  const base::Image8 shown = magmaImage(map);
  constexpr int kEntries[] = {0, 255, 0, 255, 0, 128};
  for (int x = 0; x < 6; ++x)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(shown.at(x, 0)[c], magmaColor(kEntries[x])[c]) << x;
  map.pixels[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(magmaImage(map), base::Error);
  EXPECT_THROW(magmaImage(base::Image(2, 2, 3)), base::Error);
}

} // namespace
} // namespace parity::compare
