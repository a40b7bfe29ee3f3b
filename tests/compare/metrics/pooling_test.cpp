// Means, percentiles, shares and histograms against sorting and closed forms; NaN never passes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "compare/pooling/pooling.h"
#include "error_code.h"
#include "support/not_finite.h"

namespace parity::compare {
namespace {

using tests::kInf, tests::kNan;

float percentile(const std::vector<float>& values, const std::vector<float>& weights, double p) {
  return weightedPercentiles(values, weights, std::vector<double>{p})[0];
}

// The definition (docs/flip-metric.md 7), by sorting.
float sortedPercentile(const std::vector<float>& values, const std::vector<float>& weights, double p) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const auto weightOf = [&](std::size_t i) { return weights.empty() ? 1. : static_cast<double>(weights[i]); };
  double total = 0, running = 0;
  for (std::size_t i : order) total += weightOf(i);
  for (std::size_t i : order) {
    running += weightOf(i);
    if (running > p * total) return values[i];
  }
  return values[order.back()];
}

TEST(Percentiles, OfOneToAHundredAreTheFirstWhoseRankExceedsTheShare) {
  std::vector<float> values(100);
  std::iota(values.begin(), values.end(), 1.f);
  std::shuffle(values.begin(), values.end(), std::mt19937(3));
  EXPECT_EQ(percentile(values, {}, 0), 1.f);
  EXPECT_EQ(percentile(values, {}, 0.25), 26.f);
  EXPECT_EQ(percentile(values, {}, 0.5), 51.f);
  EXPECT_EQ(percentile(values, {}, 0.949), 95.f);
  EXPECT_EQ(percentile(values, {}, 1), 100.f);
}

TEST(Percentiles, WeightsShiftThem) {
  EXPECT_EQ(percentile({1, 2, 3}, {1, 1, 6}, 0.5), 3.f);
  EXPECT_EQ(percentile({1, 2, 3}, {6, 1, 1}, 0.5), 1.f);
  EXPECT_EQ(percentile({3, 1, 2}, {0, 1, 1}, 1), 2.f); // a value of no weight is never the answer
  EXPECT_EQ(percentile({7}, {0.125f}, 0.95), 7.f);
}

TEST(Percentiles, SelectionGivesTheValueThatSortingGives) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> uniform(-1.f, 1.f);
  for (int round = 0; round < 200; ++round) {
    std::vector<float> values(1 + random() % 700), weights;
    // Coarse values make ties; weights of 64ths keep every sum exact, so that both orders of adding agree.
    for (float& v : values) v = round % 2 == 0 ? uniform(random) : std::round(8.f * uniform(random)) / 8.f;
    if (round % 3 != 0)
      for (std::size_t i = 0; i < values.size(); ++i) weights.push_back(static_cast<float>(1 + random() % 64) / 64.f);
    for (double p : {0., 0.1, 0.25, 0.5, 0.75, 0.95, 0.999, 1.})
      ASSERT_EQ(percentile(values, weights, p), sortedPercentile(values, weights, p)) << round << ", " << p;
  }
}

TEST(Percentiles, NothingToRankIsAnError) {
  using base::ExitCode;
  EXPECT_EQ(test::codeOf([] { percentile({}, {}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { percentile({1, kNan}, {}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { percentile({1, 2}, {0, 0}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { percentile({1, 2}, {1}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { percentile({1, 2}, {1, -1}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { percentile({1, 2}, {1, kNan}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { percentile({1, 2}, {}, 1.5); }), ExitCode::failed);
}

TEST(Pooling, PercentilesAreWeightedByTheValuesThemselves) {
  base::Image map(2, 2, 1);
  map.pixels = {0.4f, 0.1f, 0.2f, 0.1f}; // running sums 0.1 0.2 0.4 0.8
  const Pooling pooled = poolMap(map);
  EXPECT_NEAR(pooled.mean, 0.2, 1e-8);
  EXPECT_EQ(pooled.weightedQ1, static_cast<double>(0.2f)); // the sum reaches 0.2 with floats a hair above a quarter
  EXPECT_EQ(pooled.weightedMedian, static_cast<double>(0.4f));
  EXPECT_EQ(pooled.weightedQ3, static_cast<double>(0.4f));
  EXPECT_EQ(pooled.min, static_cast<double>(0.1f));
  EXPECT_EQ(pooled.max, static_cast<double>(0.4f));
}

TEST(Pooling, TheHistogramCountsHundredthsAndPutsOneIntoTheLast) {
  base::Image map(8, 1, 1);
  map.pixels = {0.f, 0.005f, 0.01f, 0.5f, 0.504f, 0.989f, 0.995f, 1.f};
  const Pooling pooled = poolMap(map);
  EXPECT_EQ(pooled.histogram[0], 2u);
  EXPECT_EQ(pooled.histogram[1], 1u);
  EXPECT_EQ(pooled.histogram[50], 2u);
  EXPECT_EQ(pooled.histogram[98], 1u);
  EXPECT_EQ(pooled.histogram[99], 2u);
  EXPECT_EQ(std::accumulate(pooled.histogram.begin(), pooled.histogram.end(), std::uint64_t{0}), 8u);
}

// Float sums stall: the reference tool's mean is off by 1e-3 at this size (docs/flip-metric.md 9a).
TEST(Pooling, TheMeanOfA4kMapDoesNotDrift) {
  const base::Image map(3840, 2160, 1, 0.1f);
  EXPECT_NEAR(poolMap(map).mean, static_cast<double>(0.1f), 1e-9);
}

TEST(Pooling, AnAllZeroMapPoolsToZeroAndABadOneIsRefused) {
  const Pooling pooled = poolMap(base::Image(3, 3, 1));
  EXPECT_EQ(pooled.mean, 0);
  EXPECT_EQ(pooled.weightedQ3, 0);
  EXPECT_EQ(test::codeOf([] { poolMap(base::Image()); }), base::ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { poolMap(base::Image(3, 3, 3)); }), base::ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { poolMap(base::Image(3, 3, 1, kNan)); }), base::ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { poolMap(base::Image(3, 3, 1, kInf)); }), base::ExitCode::failed);
  EXPECT_EQ(test::codeOf([] { poolMap(base::Image(3, 3, 1, -0.1f)); }), base::ExitCode::failed);
}

// A 4K map of uneven values against long double sums and sorting.
TEST(Pooling, OfA4kMapIsWhatSortingInLongDoubleGives) {
  base::Image map(3840, 2160, 1);
  std::mt19937 random(4);
  for (float& v : map.pixels) {
    const float unit = static_cast<float>(random() >> 8) / 16777216.f;
    v = unit * unit * unit;
  }
  const Pooling pooled = poolMap(map);
  std::vector<float> sorted = map.pixels;
  std::sort(sorted.begin(), sorted.end());
  long double total = 0;
  for (const float v : sorted) total += static_cast<long double>(v);
  EXPECT_NEAR(pooled.mean, static_cast<double>(total / static_cast<long double>(sorted.size())), 1e-12);
  const auto expectPercentile = [&](double actual, double fraction) {
    // Sums in another order may stop one value earlier or later.
    long double running = 0;
    std::size_t i = 0;
    while (i + 1 < sorted.size() && (running += static_cast<long double>(sorted[i])) <= fraction * total) ++i;
    EXPECT_GE(actual, static_cast<double>(sorted[i - 1])) << fraction;
    EXPECT_LE(actual, static_cast<double>(sorted[i + 1])) << fraction;
  };
  expectPercentile(pooled.weightedQ1, 0.25);
  expectPercentile(pooled.weightedMedian, 0.5);
  expectPercentile(pooled.weightedQ3, 0.75);
}

// Weights of 64ths and values of 2^-20ths keep every sum exact.
struct Sample {
  base::Image plane{257, 311, 1};
  base::PixelList list;
  std::vector<float> values; // of the list
};
Sample makeSample(bool weighted, float least, float most) {
  Sample sample;
  std::mt19937 random(11);
  for (float& v : sample.plane.pixels)
    v = least + (most - least) * std::round(static_cast<float>(random() % 4096)) / 4096.f;
  for (std::uint32_t pixel = 0; pixel < sample.plane.pixels.size(); ++pixel) {
    if (random() % 5 == 0) continue;
    sample.list.pixels.push_back(pixel);
    sample.values.push_back(sample.plane.pixels[pixel]);
    if (weighted) sample.list.weights.push_back(static_cast<float>(1 + random() % 64) / 64.f);
  }
  return sample;
}

TEST(PoolPlane, OverARegionIsWhatSortingItsValuesGives) {
  for (const bool weighted : {false, true})
    for (const float most : {1.f, 100.f, 1e-5f, 3000.f}) { // within the histogram's range, below and above it
      const Sample sample = makeSample(weighted, most > 1.5f ? 0.f : -most, most);
      const RegionRuns region = runsOf(sample.list, sample.plane.width, sample.plane.height);
      const float threshold = 0.375f * most;
      const std::vector<double> fractions = {0, 0.05, 0.5, 0.95, 0.99, 1};
      const Distribution found =
          poolPlane(sample.plane, region, {fractions, {static_cast<double>(threshold), static_cast<double>(most)}});
      double sum = 0, total = 0, above = 0;
      for (std::size_t i = 0; i < sample.values.size(); ++i) {
        const double w = weighted ? static_cast<double>(sample.list.weights[i]) : 1.;
        total += w;
        sum += w * static_cast<double>(sample.values[i]);
        if (sample.values[i] > threshold) above += w;
      }
      EXPECT_NEAR(found.mean, sum / total, 1e-12 * static_cast<double>(most));
      EXPECT_NEAR(found.shares[0], above / total, 1e-12);
      EXPECT_EQ(found.shares[1], 0); // nothing is above the largest
      EXPECT_EQ(found.min, static_cast<double>(*std::min_element(sample.values.begin(), sample.values.end())));
      EXPECT_EQ(found.max, static_cast<double>(*std::max_element(sample.values.begin(), sample.values.end())));
      for (std::size_t i = 0; i < fractions.size(); ++i)
        EXPECT_EQ(found.percentiles[i],
                  static_cast<double>(sortedPercentile(sample.values, sample.list.weights, fractions[i])))
            << fractions[i] << " of " << most;
      EXPECT_EQ(meanOf(sample.plane, region), found.mean);
      EXPECT_EQ(largestOf(sample.plane, region), found.max);
    }
}

TEST(PoolPlane, DoesNotDependOnTheNumberOfThreads) {
  base::Image plane(1024, 512, 1);
  std::mt19937 random(12);
  for (float& v : plane.pixels) v = static_cast<float>(random() >> 8) / 16777216.f;
  base::PixelList list;
  list.pixels.resize(plane.pixels.size());
  std::iota(list.pixels.begin(), list.pixels.end(), 0u);
  const RegionRuns region = runsOf(list, plane.width, plane.height);
  const DistributionRequest request{{0.5, 0.95}, {0.1}};
  const Distribution many = poolPlane(plane, region, request);
  const base::ThreadLimit one(1);
  const Distribution single = poolPlane(plane, region, request);
  EXPECT_EQ(many.mean, single.mean);
  EXPECT_EQ(many.percentiles, single.percentiles);
  EXPECT_EQ(many.shares, single.shares);
}

} // namespace
} // namespace parity::compare
