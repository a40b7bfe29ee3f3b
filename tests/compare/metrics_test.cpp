// RMSE, PSNR, percentiles, pooling and figures on closed forms; NaN never passes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "compare/metrics.h"
#include "compare/region.h"

namespace parity::compare {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();

base::ExitCode codeOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const base::Error& error) {
    return error.code();
  }
  return base::ExitCode::withinBudget;
}

float percentile(const std::vector<float>& values, const std::vector<float>& weights, double p) {
  return weightedPercentiles(values, weights, std::vector<double>{p})[0];
}

// The definition (FLIP.md, pooling), by sorting.
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

TEST(Percentiles, ofOneToAHundredAreTheFirstWhoseRankExceedsTheShare) {
  std::vector<float> values(100);
  std::iota(values.begin(), values.end(), 1.f);
  std::shuffle(values.begin(), values.end(), std::mt19937(3));
  EXPECT_EQ(percentile(values, {}, 0), 1.f);
  EXPECT_EQ(percentile(values, {}, 0.25), 26.f);
  EXPECT_EQ(percentile(values, {}, 0.5), 51.f);
  EXPECT_EQ(percentile(values, {}, 0.949), 95.f);
  EXPECT_EQ(percentile(values, {}, 1), 100.f);
}

TEST(Percentiles, weightsShiftThem) {
  EXPECT_EQ(percentile({1, 2, 3}, {1, 1, 6}, 0.5), 3.f);
  EXPECT_EQ(percentile({1, 2, 3}, {6, 1, 1}, 0.5), 1.f);
  EXPECT_EQ(percentile({3, 1, 2}, {0, 1, 1}, 1), 2.f); // a value of no weight is never the answer
  EXPECT_EQ(percentile({7}, {0.125f}, 0.95), 7.f);
}

TEST(Percentiles, selectionGivesTheValueThatSortingGives) {
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

TEST(Percentiles, nothingToRankIsAnError) {
  using base::ExitCode;
  EXPECT_EQ(codeOf([] { percentile({}, {}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(codeOf([] { percentile({1, kNan}, {}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(codeOf([] { percentile({1, 2}, {0, 0}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(codeOf([] { percentile({1, 2}, {1}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(codeOf([] { percentile({1, 2}, {1, -1}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(codeOf([] { percentile({1, 2}, {1, kNan}, 0.5); }), ExitCode::failed);
  EXPECT_EQ(codeOf([] { percentile({1, 2}, {}, 1.5); }), ExitCode::failed);
}

TEST(Pooling, percentilesAreWeightedByTheValuesThemselves) {
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

// Float sums stall: the reference tool's mean is off by 1e-3 at this size (FLIP.md, faults).
TEST(Pooling, theMeanOfA4kMapDoesNotDrift) {
  const base::Image map(3840, 2160, 1, 0.1f);
  EXPECT_NEAR(poolMap(map).mean, static_cast<double>(0.1f), 1e-9);
}

TEST(Pooling, anAllZeroMapPoolsToZeroAndABadOneIsRefused) {
  const Pooling pooled = poolMap(base::Image(3, 3, 1));
  EXPECT_EQ(pooled.mean, 0);
  EXPECT_EQ(pooled.weightedQ3, 0);
  EXPECT_EQ(codeOf([] { poolMap(base::Image()); }), base::ExitCode::failed);
  EXPECT_EQ(codeOf([] { poolMap(base::Image(3, 3, 3)); }), base::ExitCode::failed);
  EXPECT_EQ(codeOf([] { poolMap(base::Image(3, 3, 1, kNan)); }), base::ExitCode::failed);
}

TEST(Rmse, ofAConstantOffsetIsTheOffset) {
  const base::Image a(7, 5, 3, 0.25f), b(7, 5, 3, 0.75f);
  EXPECT_DOUBLE_EQ(rmse(a, b), 0.5);
  EXPECT_NEAR(psnr(a, b), 6.020599913, 1e-8); // 10 log10(4)
}

TEST(Rmse, ofOneWrongChannelIsSpreadOverAll) {
  const base::Image a(4, 4, 3);
  base::Image b = a;
  b.at(2, 1)[0] = 1.f;
  EXPECT_DOUBLE_EQ(rmse(a, b), std::sqrt(1. / 48));
  EXPECT_NEAR(psnr(a, b), 10 * std::log10(48.), 1e-9);
}

TEST(Psnr, ofIdenticalImagesIsInfinite) {
  const base::Image image(4, 4, 3, 0.3f);
  EXPECT_EQ(rmse(image, image), 0);
  EXPECT_EQ(psnr(image, image), std::numeric_limits<double>::infinity());
}

TEST(Rmse, unlikeOrNonFiniteImagesAreAnError) {
  const base::Image image(4, 4, 3), bad(4, 4, 3, kNan);
  EXPECT_EQ(codeOf([&] { rmse(image, base::Image(4, 5, 3)); }), base::ExitCode::notComparable);
  EXPECT_EQ(codeOf([&] { rmse(base::Image(), base::Image()); }), base::ExitCode::notComparable);
  EXPECT_EQ(codeOf([&] { rmse(image, bad); }), base::ExitCode::failed);
  EXPECT_EQ(codeOf([&] { psnr(bad, bad); }), base::ExitCode::failed);
}

TEST(NonFinite, isCountedPerPixelWithTheFirstInRowOrder) {
  base::Image image(300, 4, 3, -1e38f);
  EXPECT_EQ(countNonFinite(image).count, 0u);
  image.at(7, 3)[0] = kNan;
  image.at(299, 1)[2] = -kInf;
  image.at(299, 1)[1] = kInf;
  image.at(3, 3)[1] = kInf;
  const NonFinite found = countNonFinite(image);
  EXPECT_EQ(found.count, 3u);
  EXPECT_EQ(found.x, 299);
  EXPECT_EQ(found.y, 1);
}

struct Pair {
  base::Image reference{4, 2, 3, 0.5f}, test{4, 2, 3, 0.5f}, map{4, 2, 1};
};

TEST(Measure, figuresOfARegionAreTheirClosedForms) {
  Pair p;
  p.map.pixels = {0.1f, 0.2f, 0.3f, 0.4f, 1, 1, 1, 1};
  for (int x = 0; x < 2; ++x)
    for (int c = 0; c < 3; ++c) p.test.at(x, 0)[c] = 0.75f;
  const Figures f = measure(p.reference, p.test, p.map, {"m", {0, 1, 2, 3}, {}});
  EXPECT_EQ(f.pixels, 4u);
  EXPECT_EQ(f.nonFinite, 0u);
  EXPECT_NEAR(f.flip.mean, 0.25, 1e-8);
  EXPECT_EQ(f.flip.p50, static_cast<double>(0.3f));
  EXPECT_EQ(f.flip.p95, static_cast<double>(0.4f));
  EXPECT_EQ(f.flip.max, static_cast<double>(0.4f));
  EXPECT_NEAR(f.rmse, 0.25 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(f.psnr, 10 * std::log10(32.), 1e-9);
  EXPECT_NEAR(f.referenceLuma, 0.5, 1e-12);
  EXPECT_NEAR(f.testLuma, 0.625, 1e-12);
}

TEST(Measure, pixelWeightsCountAsSharesOfAPixel) {
  Pair p;
  p.map.pixels = {0.f, 1.f, 0.5f, 0, 0, 0, 0, 0};
  p.test.at(1, 0)[1] = 1.f;
  const Figures f = measure(p.reference, p.test, p.map, {"m", {0, 1, 2}, {1.f, 0.25f, 0.f}});
  EXPECT_EQ(f.pixels, 2u); // a weight of 0 is not in the region
  EXPECT_NEAR(f.flip.mean, 0.2, 1e-12);
  EXPECT_EQ(f.flip.p50, 0);
  EXPECT_EQ(f.flip.p95, 1);
  EXPECT_NEAR(f.rmse, std::sqrt(0.25 * 0.25 / (3 * 1.25)), 1e-12);
  EXPECT_NEAR(f.testLuma, 0.5 + 0.2 * 0.5 * 0.7152, 1e-12);
}

TEST(Measure, anEmptyRegionHasNoPixelsAndNoNan) {
  const Pair p;
  for (const base::PixelList& list : {base::PixelList{"none", {}, {}}, base::PixelList{"weightless", {1, 2}, {0, 0}}}) {
    const Figures f = measure(p.reference, p.test, p.map, list);
    EXPECT_EQ(f.pixels, 0u);
    for (double v : {f.flip.mean, f.flip.p50, f.flip.p95, f.flip.max, f.rmse, f.psnr, f.referenceLuma, f.testLuma})
      EXPECT_EQ(v, 0);
  }
}

TEST(Measure, nonFinitePixelsAreCountedAndEnterAsTheLargestError) {
  Pair p;
  p.reference.at(0, 0)[1] = kNan;
  p.test.at(1, 0)[0] = kInf;
  p.map.pixels[2] = kNan;
  const Figures f = measure(p.reference, p.test, p.map, {"m", {0, 1, 2, 3}, {}});
  EXPECT_EQ(f.pixels, 4u);
  EXPECT_EQ(f.nonFinite, 3u);
  EXPECT_NEAR(f.flip.mean, 0.75, 1e-12);
  EXPECT_EQ(f.flip.max, 1);
  EXPECT_NEAR(f.rmse, std::sqrt(0.75), 1e-12);
  EXPECT_TRUE(std::isfinite(f.psnr) && std::isfinite(f.referenceLuma) && std::isfinite(f.testLuma));
}

TEST(Measure, identicalRegionsHaveInfinitePsnr) {
  const Pair p;
  EXPECT_EQ(measure(p.reference, p.test, p.map, {"m", {5}, {}}).psnr, std::numeric_limits<double>::infinity());
}

TEST(Measure, malformedRegionsAndUnlikeImagesAreErrors) {
  const Pair p;
  const auto code = [&](const base::PixelList& list) {
    return codeOf([&] { measure(p.reference, p.test, p.map, list); });
  };
  EXPECT_EQ(code({"m", {8}, {}}), base::ExitCode::failed);
  EXPECT_EQ(code({"m", {2, 1}, {}}), base::ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 1}, {}}), base::ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 2}, {1}}), base::ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 2}, {1, -1}}), base::ExitCode::failed);
  EXPECT_EQ(code({"m", {1, 2}, {1, kNan}}), base::ExitCode::failed);
  const base::PixelList good{"m", {1}, {}};
  EXPECT_EQ(codeOf([&] { measure(p.reference, base::Image(4, 3, 3), p.map, good); }), base::ExitCode::notComparable);
  EXPECT_EQ(codeOf([&] { measure(p.reference, p.test, base::Image(4, 3, 1), good); }), base::ExitCode::notComparable);
  EXPECT_EQ(codeOf([&] { measure(p.reference, p.test, p.reference, good); }), base::ExitCode::notComparable);
}

} // namespace
} // namespace parity::compare
