// Where the points lie.
#include "study/stress/domain.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "study/stress/function_table.h"

namespace parity::tests {
namespace {

using namespace stress;

TEST(StressDomain, PointsLieWithinAndReachBothEnds) {
  Domain domain;
  domain.inputs = {unit(0, "u"), cosine(1, "c"), within(2, "w", -3, 5), powers(3, "p", 0, 1e6, 1e-6, 1e6),
                   direction(4, "d")};
  std::set<double> seen[4];
  for (std::uint32_t i = 0; i < 4096; ++i) {
    const Row row = samplePoint(domain, i);
    ASSERT_TRUE(domain.contains(row));
    for (int k = 0; k < 4; ++k) seen[k].insert(row[static_cast<std::size_t>(k)]);
  }
  const double ends[4][2] = {{0, 1}, {-1, 1}, {-3, 5}, {0, 1e6}};
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(*seen[k].begin(), ends[k][0]);
    EXPECT_EQ(*seen[k].rbegin(), ends[k][1]);
  }
}

// Half of a unit input evenly, the rest by powers of two towards both ends; 1/64 at each end.
TEST(StressDomain, UnitInputsCrowdTowardsBothEnds) {
  Domain domain;
  domain.inputs = {unit(0, "u")};
  constexpr int kPoints = 1 << 14;
  int tiny = 0, middle = 0, nearOne = 0;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const double u = samplePoint(domain, i)[0];
    tiny += u > 0 && u < 1e-3;
    nearOne += u < 1 && u > 0.999;
    middle += u >= 0.25 && u < 0.75;
  }
  EXPECT_NEAR(tiny, kPoints * 0.97 * (0.25 * (1 - 10.0 / 24) + 0.0005), kPoints * 0.01);
  EXPECT_NEAR(nearOne, kPoints * 0.97 * (0.25 * (1 - 10.0 / 24) + 0.0005), kPoints * 0.01);
  EXPECT_NEAR(middle, kPoints * 0.97 * (0.25 + 2 * 0.25 / 24 * (std::log2(3.0) + 0.415) / 2), kPoints * 0.015);
}

// The first 2^k points are stratified in each dimension, also where the dimensions are many.
TEST(StressDomain, PointsAreOfLowDiscrepancyInEveryDimension) {
  Domain domain;
  for (int k = 0; k < 20; ++k) domain.inputs.push_back(within(k, "x", 0, 1));
  constexpr std::uint32_t kPoints = 256;
  for (int k = 0; k < 20; ++k) {
    std::set<int> cells;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
      const double u = samplePoint(domain, i)[static_cast<std::size_t>(k)];
      if (u > 0 && u < 1) cells.insert(static_cast<int>(u * 200));
    }
    EXPECT_GT(cells.size(), 170u) << "dimension " << k; // of random points 144 cells would be met, +-6
  }
}

TEST(StressDomain, TheGridHoldsEachSpecialValueOfEachInputAndAllPairs) {
  Domain domain;
  domain.inputs = {unit(0, "a"), within(1, "b", -2, 3), direction(2, "d")};
  const SpecialGrid grid(domain);
  const std::size_t values = specialValues().size() + 2;
  EXPECT_EQ(grid.size(), 1 + 5 * values + 10 * values * values);
  std::set<std::pair<std::string, std::string>> pairs;
  std::set<std::string> first;
  int nan = 0;
  for (std::uint64_t i = 0; i < grid.size(); ++i) {
    const Row row = grid.row(i);
    first.insert(std::to_string(row[0]) + (std::signbit(row[0]) ? "-" : ""));
    pairs.insert({std::to_string(row[0]), std::to_string(row[1])});
    nan += std::isnan(row[4]);
  }
  EXPECT_GE(nan, 1);
  EXPECT_TRUE(pairs.count({"nan", "inf"}));
  EXPECT_TRUE(pairs.count({"0.000000", "3.000000"})) << "the ends of the range are among the values";
  EXPECT_TRUE(pairs.count({"65504.000000", "-inf"}));
}

TEST(StressDomain, SpecialValuesAreThoseOfBothFormats) {
  const std::vector<double>& values = specialValues();
  const auto has = [&](double x) { return std::find(values.begin(), values.end(), x) != values.end(); };
  for (const double x : {0.0, 0x1p-149, 0x1.fffffcp-127, 0x1p-126, 0x1p-24, 0x1p-14 - 0x1p-24, 0x1p-14, 1 - 0x1p-24,
                         1 - 0x1p-11, 1.0, 1 + 0x1p-23, 1 + 0x1p-10, 65504.0, 1e6, HUGE_VAL, -HUGE_VAL, -1.0})
    EXPECT_TRUE(has(x)) << x;
  EXPECT_TRUE(std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); }));
}

TEST(StressDomain, RoundsToHalfButForWideInputs) {
  Domain domain;
  domain.inputs = {unit(0, "half"), wide(unit(1, "single"))};
  const Row row = roundTo(Precision::f16, domain, Row{0.1, 0.1});
  EXPECT_EQ(row[0], 0.0999755859375);
  EXPECT_EQ(row[1], static_cast<double>(0.1f));
  EXPECT_EQ(roundTo(Precision::f64, domain, Row{0.1, 0.1})[0], static_cast<double>(0.1f)) << "the rows of fp32";
}

TEST(StressDomain, ASettledPointKeepsItsConstraint) {
  int constrained = 0;
  for (const FunctionCase& function : functionTable()) {
    if (!function.domain.holds) continue;
    ++constrained;
    int within = 0;
    for (std::uint32_t i = 0; i < 1000; ++i) within += function.domain.contains(samplePoint(function.domain, i));
    EXPECT_GT(within, 900) << function.name;
  }
  EXPECT_GE(constrained, 6);
}

} // namespace
} // namespace parity::tests
