// Points come as often as a guide wants them, and near ones stay near.
#include "bake/light/direction_guide.h"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/sampling.h"

namespace parity::bake {
namespace {

std::array<double, DirectionGuide::kCells> someWishes() {
  std::array<double, DirectionGuide::kCells> wanted{};
  for (std::size_t i = 0; i < wanted.size(); ++i)
    wanted[i] = 1 + 9 * (0.5 + 0.5 * std::sin(0.37 * static_cast<double>(i))) + (i == 321 ? 200 : 0);
  return wanted;
}

TEST(DirectionGuide, TakesPointsInProportionToWhatIsWanted) {
  const auto wanted = someWishes();
  double total = 0;
  for (const double w : wanted) total += w;
  const DirectionGuide guide(wanted);
  constexpr std::uint32_t kCount = 1 << 18;
  std::array<int, DirectionGuide::kCells> counts{};
  double inverse = 0; // the mean of 1 / density is the area of the square
  for (std::uint32_t i = 0; i < kCount; ++i) {
    glm::dvec2 u = reference::sobolPoint(i, 3);
    const double density = guide.warp(u);
    ASSERT_TRUE(u.x >= 0 && u.x <= 1 && u.y >= 0 && u.y <= 1);
    const std::size_t cell = DirectionGuide::cellOf(u);
    ++counts[cell];
    inverse += 1 / density / kCount;
    // Not where rounding takes a cell's rim for its neighbour.
    const glm::dvec2 within = glm::fract(u * glm::dvec2(DirectionGuide::kRows, DirectionGuide::kColumns));
    if (std::min({within.x, within.y, 1 - within.x, 1 - within.y}) > 1e-6) {
      ASSERT_NEAR(density, wanted[cell] * DirectionGuide::kCells / total, 1e-9 * density);
    }
  }
  EXPECT_NEAR(inverse, 1, 1e-3);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = kCount * wanted[i] / total;
    EXPECT_NEAR(counts[i], expected, 5 * std::sqrt(expected)) << i;
  }
}

TEST(DirectionGuide, IsEvenWithoutWishes) {
  glm::dvec2 u(0.3, 0.7);
  EXPECT_EQ(DirectionGuide().warp(u), 1);
  EXPECT_EQ(u, glm::dvec2(0.3, 0.7));
}

} // namespace
} // namespace parity::bake
