// Medians, intervals and exponents of measurements.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "study/sweep/statistics.h"

namespace parity::sweep {
namespace {

TEST(Quantile, IsLinearBetweenNeighbours) {
  // R: quantile(c(3, 1, 4, 1, 5), c(0, .25, .5, .9, 1)), type 7
  const std::vector<double> values = {3, 1, 4, 1, 5};
  EXPECT_DOUBLE_EQ(quantileOf(values, 0), 1);
  EXPECT_DOUBLE_EQ(quantileOf(values, 0.25), 1);
  EXPECT_DOUBLE_EQ(quantileOf(values, 0.5), 3);
  EXPECT_DOUBLE_EQ(quantileOf(values, 0.9), 4.6);
  EXPECT_DOUBLE_EQ(quantileOf(values, 1), 5);
  EXPECT_DOUBLE_EQ(quantileOf({7}, 0.3), 7);
}

TEST(Quantile, SpreadOfNothingIsZero) {
  EXPECT_EQ(spreadOf({}).median, 0);
  const Spread spread = spreadOf({1, 2, 3, 4, 5});
  EXPECT_EQ(spread.low, 2);
  EXPECT_EQ(spread.median, 3);
  EXPECT_EQ(spread.high, 4);
}

// Run times of 10 ms with 5 % of noise and now and then a hiccup, which only adds.
std::vector<double> drawTimes(std::mt19937& random, std::size_t count, double scale) {
  std::lognormal_distribution<double> noise(0, 0.05);
  std::vector<double> times(count);
  for (double& time : times) time = scale * 10 * noise(random) + (random() % 10 == 0 ? 5 : 0);
  return times;
}

// At least nearly as often as promised. Medians of few values are coarse, so some percent are lost.
TEST(Bootstrap, IntervalHoldsTheTrueRatioAsOftenAsItSays) {
  for (const double truth : {1.0, 1.3}) {
    std::mt19937 random(7);
    int held = 0;
    constexpr int kTrials = 400;
    for (int trial = 0; trial < kTrials; ++trial) {
      const Ratio ratio = bootstrapRatio(drawTimes(random, 15, 1), drawTimes(random, 15, truth), 0.95, 500);
      EXPECT_LE(ratio.low, ratio.high);
      held += ratio.low <= truth && truth <= ratio.high;
    }
    EXPECT_GT(held, 0.90 * kTrials) << truth;
    EXPECT_LT(held, kTrials) << "an interval that is never wrong is too wide";
  }
}

TEST(Bootstrap, TwiceTheTimeIsSlowerAndTheSameTimesAreNeither) {
  std::mt19937 random(3);
  const std::vector<double> before = drawTimes(random, 9, 1);
  std::vector<double> twice = before;
  for (double& time : twice) time *= 2;
  const Ratio slower = bootstrapRatio(before, twice, 0.999), faster = bootstrapRatio(twice, before, 0.999),
              same = bootstrapRatio(before, before, 0.95);
  EXPECT_DOUBLE_EQ(slower.ratio, 2);
  EXPECT_TRUE(slower.isSlower());
  EXPECT_FALSE(slower.isFaster());
  EXPECT_TRUE(faster.isFaster());
  EXPECT_FALSE(same.isSlower() || same.isFaster());
}

TEST(Bootstrap, IsTheSameForTheSameSeedAndRefusesWhatIsNoTime) {
  const std::vector<double> a = {1, 2, 3, 4}, b = {2, 3, 4, 5};
  EXPECT_EQ(bootstrapRatio(a, b, 0.9).low, bootstrapRatio(a, b, 0.9).low);
  EXPECT_THROW(bootstrapRatio({1}, b, 0.9), base::Error);
  EXPECT_THROW(bootstrapRatio({1, 0}, b, 0.9), base::Error);
  EXPECT_THROW(bootstrapRatio(a, {1, std::nan("")}, 0.9), base::Error);
}

TEST(PowerLaw, FindsTheExponentOfAnExactOne) {
  std::vector<double> n, t;
  for (const double each : {1., 4., 16., 64.}) {
    n.push_back(each);
    t.push_back(3 * std::pow(each, 0.75));
  }
  const PowerLaw law = fitPowerLaw(n, t);
  EXPECT_NEAR(law.exponent, 0.75, 1e-12);
  EXPECT_NEAR(law.factor, 3, 1e-12);
  EXPECT_THROW(fitPowerLaw({2, 2}, {1, 3}), base::Error);
  EXPECT_THROW(fitPowerLaw({1, 2}, {1, 0}), base::Error);
}

} // namespace
} // namespace parity::sweep
