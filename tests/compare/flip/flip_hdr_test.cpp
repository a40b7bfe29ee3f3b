// HDR-FLIP: the maps and ranges that NVIDIA's C++ tool v1.6 made of the pair in golden/, the plain oracle, and the
// pairs that tool passes in silence.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/image/image_io.h"
#include "base/parallel.h"
#include "base/simd_level.h"
#include "compare/flip/flip_hdr.h"
#include "compare/flip/flip_simd.h"
#include "compare/metrics/metrics.h"
#include "flip_oracle_hdr.h"
#include "golden.h"
#include "random_images.h"

namespace parity::compare {
namespace {

using test::makeHdrImage;

// docs/flip-metric.md 8's table.
struct HdrCase {
  std::string map;
  HdrFlipOptions options;
  ExposureRange range;
  double mean, median, q1, q3, min, max;
};

const HdrCase kHdrCases[] = {
    {"aces",
     {.tonemapper = Tonemapper::aces},
     {-6.58165932f, 2.22690272f, 9, ""},
     .134915589,
     .169763058,
     .131586596,
     .193702623,
     .000591856,
     .283764094},
    {"hable",
     {.tonemapper = Tonemapper::hable},
     {-6.01983118f, 2.78873062f, 9, ""},
     .116582022,
     .138141409,
     .108528778,
     .159562722,
     .003071304,
     .252925843},
    {"reinhard",
     {.tonemapper = Tonemapper::reinhard},
     {-5.16245604f, 3.646106f, 9, ""},
     .125366919,
     .14458482,
     .118122637,
     .168207914,
     .001194948,
     .280201226},
    {"manual",
     {.tonemapper = Tonemapper::aces, .start = -4.f, .stop = 3.f, .exposures = 5},
     {-4, 3, 5, ""},
     .130301540,
     .160217822,
     .121681638,
     .187391534,
     .001430407,
     .277799636},
};

void PrintTo(const HdrCase& c, std::ostream* out) { *out << c.map; }

class HdrFlipGolden : public ::testing::TestWithParam<HdrCase> {
protected:
  static HdrFlip compute() {
    return flipHdr(base::readImage(test::goldenFolder() / "hdrsyn256.ref.exr"),
                   base::readImage(test::goldenFolder() / "hdrsyn256.test.exr"), GetParam().options);
  }
};

TEST_P(HdrFlipGolden, EveryPixelIsTheReferenceToolsWithin1e4) {
  EXPECT_TRUE(test::matchesGolden(compute().flip, "hdrsyn256." + GetParam().map + ".flip", 1e-4));
}

// Where two exposures come out within the tolerance of each other, either may be named: the error must then be equal.
TEST_P(HdrFlipGolden, ExposuresAreTheReferenceToolsButForTies) {
  const HdrFlip found = compute();
  const base::Image expected = base::readPfm(test::goldenFolder() / ("hdrsyn256." + GetParam().map + ".exposure.pfm"));
  std::size_t different = 0;
  for (std::size_t i = 0; i < expected.pixels.size(); ++i)
    different += std::fabs(found.exposure.pixels[i] - expected.pixels[i]) > 1e-5f;
  EXPECT_LE(different, expected.pixels.size() / 1000);
}

TEST_P(HdrFlipGolden, TheRangeAndThePooledFiguresAreWhatTheToolPrints) {
  const HdrCase& c = GetParam();
  const HdrFlip found = compute();
  EXPECT_NEAR(found.range.start, c.range.start, 2e-6f);
  EXPECT_NEAR(found.range.stop, c.range.stop, 2e-6f);
  EXPECT_EQ(found.range.count, c.range.count);
  EXPECT_EQ(found.range.note, "");
  const Pooling pooled = poolMap(found.flip);
  EXPECT_NEAR(pooled.mean, c.mean, 1e-5);
  EXPECT_NEAR(pooled.weightedMedian, c.median, 1e-4);
  EXPECT_NEAR(pooled.weightedQ1, c.q1, 1e-4);
  EXPECT_NEAR(pooled.weightedQ3, c.q3, 1e-4);
  EXPECT_NEAR(pooled.min, c.min, 1e-4);
  EXPECT_NEAR(pooled.max, c.max, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Maps, HdrFlipGolden, ::testing::ValuesIn(kHdrCases),
                         [](const auto& instance) { return instance.param.map; });

TEST(HdrFlip, TheBrightestExposedValueComesOutAsPoint85) {
  EXPECT_NEAR(brightestExposed(Tonemapper::aces), 2.11887232, 1e-6); // docs/flip-metric.md 6a
  EXPECT_NEAR(brightestExposed(Tonemapper::hable), 3.12774928, 1e-5);
  EXPECT_NEAR(brightestExposed(Tonemapper::reinhard), 5.66666667, 1e-7);
}

// By sorting all of them, far apart or all in one place. Rows of a large picture are counted by several threads.
TEST(HdrFlip, TheRangeIsFromTheBrightestToTheMedianOfThePositiveLuminances) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> exponent(-100, 60), near(0.9999f, 1.0001f), share(0, 1);
  for (const auto& [width, height, isNarrow] :
       {std::tuple{300, 200, false}, {299, 201, false}, {300, 200, true}, {1, 1, false}}) {
    base::Image image(width, height, 3);
    std::vector<float> luminances;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      const float kind = share(random), size = isNarrow ? near(random) : std::exp2(exponent(random));
      float* c = &image.pixels[i];
      for (int k = 0; k < 3; ++k) c[k] = isNarrow ? size : size * share(random) + size;
      if (i > 0 && kind < 0.1f) c[0] = c[1] = c[2] = 0;
      if (i > 0 && kind > 0.9f) c[1] = -4 * size;
      if (i > 0 && kind > 0.4f && kind < 0.5f) c[0] = c[1] = c[2] = 1e-39f;
      const float luminance = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
      if (luminance >= std::numeric_limits<float>::min()) luminances.push_back(luminance);
    }
    std::ranges::sort(luminances);
    const auto exposureFor = [](float luminance) {
      return static_cast<float>(std::log2(brightestExposed(Tonemapper::aces) / static_cast<double>(luminance)));
    };
    const ExposureRange range = exposureRange(image, image, {});
    EXPECT_EQ(range.start, exposureFor(luminances.back()));
    EXPECT_EQ(range.stop, exposureFor(luminances[luminances.size() / 2]));
  }
}

class HdrFlipOracle : public ::testing::TestWithParam<std::string> {
protected:
  void SetUp() override { base::useSimdLevel(GetParam()); }
  void TearDown() override { base::useSimdLevel(""); }
};

TEST_P(HdrFlipOracle, RandomImagesMatchWithEveryToneCurve) {
  unsigned seed = 100;
  for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {41, 30}, {63, 9}})
    for (Tonemapper tonemapper : {Tonemapper::aces, Tonemapper::hable, Tonemapper::reinhard})
      for (float ppd : {15.f, kDefaultPixelsPerDegree, 150.f}) {
        const base::Image reference = makeHdrImage(width, height, seed), test = makeHdrImage(width, height, seed + 2);
        seed += 4;
        const HdrFlip fast = flipHdr(reference, test, {.ppd = ppd, .tonemapper = tonemapper});
        const auto slow = oracle::flipHdr(reference, test, static_cast<double>(ppd), tonemapper, fast.range);
        for (std::size_t i = 0; i < slow.flip.size(); ++i)
          ASSERT_NEAR(static_cast<double>(fast.flip.pixels[i]), slow.flip[i], 1e-4)
              << width << " x " << height << ", ppd " << ppd << ", pixel " << i;
      }
}

INSTANTIATE_TEST_SUITE_P(SimdLevels, HdrFlipOracle, ::testing::ValuesIn(base::simdLevels()),
                         [](const auto& instance) { return instance.param; });

TEST(HdrFlip, IdenticalImagesGiveExactlyZeroAtAnyExposure) {
  const base::Image image = makeHdrImage(40, 30, 1);
  const HdrFlip found = flipHdr(image, image);
  for (std::size_t i = 0; i < found.flip.pixels.size(); ++i) {
    ASSERT_EQ(found.flip.pixels[i], 0.f);
    ASSERT_EQ(found.exposure.pixels[i], 0.f);
  }
}

// The reference tool takes the median over all pixels: log2(x/0) = infinity, no exposures, mean 0, "identical".
TEST(HdrFlip, AMostlyBlackPairThatDiffersIsNotIdentical) {
  base::Image reference(64, 64, 3), test(64, 64, 3);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      for (int c = 0; c < 3; ++c) reference.at(x, y)[c] = 0.5f, test.at(x, y)[c] = 1.f;
  const HdrFlip found = flipHdr(reference, test);
  EXPECT_GE(found.range.count, 2);
  EXPECT_TRUE(std::isfinite(found.range.stop));
  EXPECT_GT(*found.flip.at(10, 10), 0.1f);
  EXPECT_GT(poolMap(found.flip).mean, 0.01);
}

TEST(HdrFlip, ABlackReferenceTakesTheTestsExposuresAndSaysSo) {
  const base::Image black(32, 32, 3), lit(32, 32, 3, 0.3f);
  const HdrFlip found = flipHdr(black, lit);
  EXPECT_NE(found.range.note, "");
  EXPECT_GT(poolMap(found.flip).min, 0.5);
  EXPECT_GT(poolMap(flipHdr(lit, black).flip).min, 0.5);
}

// A denormal luminance asks for more exposure than a float holds: 0 times infinity would make both images white.
TEST(HdrFlip, AReferenceOfDenormalsIsBlackAndNotIdenticalToAnything) {
  const base::Image lit(32, 32, 3, 0.3f);
  base::Image onePixel(32, 32, 3);
  *onePixel.at(5, 5) = 1e-40f;
  for (const base::Image& dark : {onePixel, base::Image(32, 32, 3, 1e-39f)}) {
    const HdrFlip found = flipHdr(dark, lit);
    EXPECT_NE(found.range.note, "");
    EXPECT_GT(poolMap(found.flip).min, 0.5);
  }
  for (float ev : {-kMaxExposureEv, kMaxExposureEv}) {
    const HdrFlip found = flipHdr(base::Image(8, 8, 3), base::Image(8, 8, 3, 1e30f), {.start = ev, .stop = ev});
    for (float v : found.flip.pixels) ASSERT_TRUE(std::isfinite(v));
    EXPECT_EQ(poolMap(found.flip).min > 0.5, ev > 0) << ev;
  }
}

TEST(HdrFlip, TwoBlackImagesAreIdenticalAndSaidToBeBlack) {
  const base::Image black(8, 8, 3);
  const HdrFlip found = flipHdr(black, black);
  EXPECT_EQ(found.range.note, "both images are black");
  for (float v : found.flip.pixels) EXPECT_EQ(v, 0.f);
}

base::ExitCode codeOf(const base::Image& reference, const base::Image& test, const HdrFlipOptions& options = {}) {
  try {
    flipHdr(reference, test, options);
  } catch (const base::Error& error) {
    return error.code();
  }
  return base::ExitCode::withinBudget;
}

TEST(HdrFlip, ImagesWithoutLightThatDifferAreNotComparable) {
  const base::Image black(8, 8, 3), negative(8, 8, 3, -1.f);
  EXPECT_EQ(codeOf(black, negative), base::ExitCode::notComparable);
  EXPECT_EQ(codeOf(black, negative, {.start = -2.f, .stop = 2.f}), base::ExitCode::withinBudget);
}

TEST(HdrFlip, AHugeRangeIsBoundedAndNoted) {
  base::Image reference(16, 16, 3, 1e-30f);
  *reference.at(0, 0) = 1e30f;
  const HdrFlip found = flipHdr(reference, base::Image(16, 16, 3, 1.f));
  EXPECT_EQ(found.range.count, kMaxExposures);
  EXPECT_NE(found.range.note, "");
}

TEST(HdrFlip, NanAndInfinityAreErrorsInEitherImage) {
  const base::Image good = makeHdrImage(20, 20, 1);
  for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    base::Image broken = good;
    *broken.at(7, 7) = bad;
    EXPECT_EQ(codeOf(broken, good), base::ExitCode::failed);
    EXPECT_EQ(codeOf(good, broken), base::ExitCode::failed);
  }
}

TEST(HdrFlip, OptionsOutOfRangeAreAUsageError) {
  const base::Image image = makeHdrImage(8, 8, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const HdrFlipOptions& options : {HdrFlipOptions{.start = 3.f, .stop = 2.f}, HdrFlipOptions{.exposures = 1},
                                        HdrFlipOptions{.exposures = kMaxExposures + 1}, HdrFlipOptions{.start = nan},
                                        HdrFlipOptions{.stop = 128.f}, HdrFlipOptions{.ppd = 0}})
    EXPECT_EQ(codeOf(image, image, options), base::ExitCode::usage);
}

TEST(HdrFlip, BytesAreNotComparable) {
  const base::Image8 bytes(4, 4, 3);
  EXPECT_THROW(flipHdr(bytes, bytes), base::Error);
}

TEST(HdrFlip, TheMapDoesNotDependOnThreads) {
  const base::Image a = makeHdrImage(530, 270, 1), b = makeHdrImage(530, 270, 3);
  base::Image first;
  for (int threads : {1, 2, 5}) {
    const base::ThreadLimit limit(threads);
    const base::Image map = flipHdr(a, b).flip;
    if (first.empty()) first = map;
    ASSERT_EQ(map, first) << threads;
  }
}

} // namespace
} // namespace parity::compare
