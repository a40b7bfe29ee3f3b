// The search against functions whose peaks are known.
#include "study/explain/search.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "study/explain/worst.h"

namespace parity::explain {
namespace {

TEST(Search, TakesFewerPicturesOfScenesOfMoreTriangles) {
  EXPECT_EQ(pointsFor(0), 2000);
  EXPECT_EQ(pointsFor(10'000'000), 250);
  for (std::size_t triangles = 1; triangles < 10'000'000; triangles *= 2)
    EXPECT_LE(pointsFor(2 * triangles), pointsFor(triangles));
  EXPECT_LT(pointsFor(100'000), pointsFor(40'000));
}

TEST(Search, SpreadsPointsEvenlyAndGoesOnWhereItStopped) {
  const auto zero = [](const std::vector<double>&) { return 0.0; };
  const std::vector<Peak> all = spreadPoints(zero, 3, 512), rest = spreadPoints(zero, 3, 256, 256);
  EXPECT_EQ(all[256].at, rest[0].at);
  // A sixteenth of each axis holds its share, 32, within 7 (of points at random one of 48 such bins is 13 off), and
  // every eighth of the cube, 64, within a fifth.
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int bin = 0; bin < 16; ++bin) {
      const auto inside =
          std::ranges::count_if(all, [&](const Peak& p) { return static_cast<int>(16 * p.at[axis]) == bin; });
      EXPECT_NEAR(static_cast<double>(inside), 32, 7) << axis << ", " << bin;
    }
  for (int cell = 0; cell < 8; ++cell) {
    const auto inside = std::ranges::count_if(all, [&](const Peak& p) {
      return (p.at[0] < 0.5) == (cell % 2 == 0) && (p.at[1] < 0.5) == (cell / 2 % 2 == 0) &&
             (p.at[2] < 0.5) == (cell / 4 == 0);
    });
    EXPECT_NEAR(static_cast<double>(inside), 64, 13) << cell;
  }
}

TEST(Search, RefinesAPeakAcrossTheSeamOfAPeriodicDimension) {
  const auto hill = [](const std::vector<double>& at) {
    const double x = std::min(std::abs(at[0] - 0.98), 1 - std::abs(at[0] - 0.98));
    return 1 - x * x - (at[1] - 0.3) * (at[1] - 0.3);
  };
  const Peak start{{0.03, 0.5}, hill({0.03, 0.5})};
  const Peak best = refine(hill, {true, false}, start, 120);
  EXPECT_NEAR(best.at[0], 0.98, 0.01);
  EXPECT_NEAR(best.at[1], 0.3, 0.01);
  EXPECT_GT(best.value, start.value);
}

TEST(Search, NeverLeavesTheStartForWorse) {
  int calls = 0;
  const Peak best = refine([&](const std::vector<double>&) { return ++calls, -1.0; }, {false}, {{0.5}, 0.25}, 10);
  EXPECT_EQ(best.value, 0.25);
  EXPECT_EQ(best.at, std::vector<double>{0.5});
  EXPECT_LE(calls, 11);
}

TEST(Search, DistancesAreOfTheLargestAxisAndWrap) {
  EXPECT_NEAR(distanceOf({0.02, 0.5}, {0.98, 0.47}, {true, false}), 0.04, 1e-12);
  EXPECT_NEAR(distanceOf({0.02, 0.5}, {0.98, 0.47}, {false, false}), 0.96, 1e-12);
}

} // namespace
} // namespace parity::explain
