// Sets of switches against their definitions, written out: every order, every set.
#include "study/explain/sets.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace parity::explain {
namespace {

std::vector<double> randomValues(std::size_t switches, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0, 1);
  std::vector<double> values(std::size_t{1} << switches);
  std::ranges::generate(values, [&] { return value(random); });
  return values;
}

TEST(Sets, TheBestOfEachSizeIsTheLeastOfAllOfThatSize) {
  for (std::size_t n = 0; n <= 5; ++n) {
    const std::vector<double> values = randomValues(n, static_cast<unsigned>(n));
    const std::vector<SwitchMask> best = bestOfEachSize(values, n);
    ASSERT_EQ(best.size(), n + 1);
    for (std::size_t size = 0; size <= n; ++size) {
      EXPECT_EQ(std::popcount(best[size]), static_cast<int>(size));
      for (SwitchMask mask = 0; mask < values.size(); ++mask)
        if (std::popcount(mask) == static_cast<int>(size)) {
          EXPECT_LE(values[best[size]], values[mask]) << n << ", " << mask;
        }
    }
  }
  EXPECT_EQ(bestOfEachSize(std::vector<double>{3, 1, 1, 2}, 2)[1], 1u) << "of equal ones the first";
}

TEST(Sets, ShapleyValuesAreMeansOverAllOrders) {
  for (std::size_t n = 1; n <= 5; ++n) {
    const std::vector<double> values = randomValues(n, 10 + static_cast<unsigned>(n));
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> expected(n, 0);
    double orders = 0;
    do {
      SwitchMask mask = 0;
      for (const std::size_t i : order) {
        const SwitchMask with = mask | SwitchMask{1} << i;
        expected[i] += values[mask] - values[with];
        mask = with;
      }
      ++orders;
    } while (std::ranges::next_permutation(order).found);
    const std::vector<double> actual = shapleyValues(values, n);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(actual[i], expected[i] / orders, 1e-12) << n << ", " << i;
    EXPECT_NEAR(std::accumulate(actual.begin(), actual.end(), 0.0), values.front() - values.back(), 1e-12);
  }
  EXPECT_TRUE(shapleyValues(std::vector<double>{1}, 0).empty());
}

TEST(Sets, ASwitchChangesItsSignWhereItHurtsAloneAndHelpsAtTheEnd) {
  // Bit 0 alone makes it worse, and better beside bit 1.
  EXPECT_EQ(changesSign(std::vector<double>{0.144, 0.178, 0.1, 0.028}, 2, 0.001), 1u);
  EXPECT_EQ(changesSign(std::vector<double>{0.144, 0.178, 0.1, 0.028}, 2, 0.05), 0u) << "too little";
  EXPECT_EQ(changesSign(std::vector<double>{0.3, 0.2, 0.2, 0.1}, 2, 0.001), 0u);
}

} // namespace
} // namespace parity::explain
