// LDR-FLIP on known answers: identical, opposite and swapped images, the reach of one pixel, bad input, threads.
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/parallel.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_filters.h"
#include "support/not_finite.h"

namespace parity::compare {
namespace {

using tests::kInf, tests::kNan;

base::Image makeFlat(int width, int height, float r, float g, float b) {
  base::Image image(width, height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    image.pixels[i] = r;
    image.pixels[i + 1] = g;
    image.pixels[i + 2] = b;
  }
  return image;
}

base::Image makeNoise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.f, 1.f);
  base::Image image(width, height, 3);
  for (float& v : image.pixels) v = uniform(random);
  return image;
}

using base::errorOf;

TEST(Flip, IdenticalImagesGiveExactlyZero) {
  for (const base::Image& image : {makeNoise(67, 45, 1), makeFlat(20, 20, 0, 0, 0), makeFlat(20, 20, 1, 1, 1)})
    for (float ppd : {10.f, kDefaultPixelsPerDegree, 200.f})
      for (float v : flipMap(image, image, {.ppd = ppd}).pixels) ASSERT_EQ(v, 0.f);
}

// Pure green against pure blue is what the colour difference is scaled by; flat fields have no features.
TEST(Flip, PureGreenAgainstPureBlueIsTheLargestDifference) {
  const FlipMaps maps = flipMaps(makeFlat(31, 31, 0, 1, 0), makeFlat(31, 31, 0, 0, 1));
  for (std::size_t i = 0; i < maps.flip.pixels.size(); ++i) {
    EXPECT_NEAR(maps.flip.pixels[i], 1.f, 1e-5f);
    EXPECT_NEAR(maps.color.pixels[i], 1.f, 1e-5f);
    EXPECT_EQ(maps.feature.pixels[i], 0.f);
  }
}

// Black against white: HyAB is 100 (no chroma), so c = 100^0.7 = 25.1188643, above the knee p = 16.5104385:
// 0.95 + 0.05 (25.1188643 - 16.5104385) / (41.2760963 - 16.5104385) = 0.967380.
TEST(Flip, BlackAgainstWhiteHasItsClosedForm) {
  for (float v : flipMap(makeFlat(25, 25, 0, 0, 0), makeFlat(25, 25, 1, 1, 1)).pixels) EXPECT_NEAR(v, 0.967380f, 2e-6f);
}

TEST(Flip, SwappedImagesGiveTheSameMap) {
  const base::Image a = makeNoise(70, 41, 2), b = makeNoise(70, 41, 3);
  const base::Image there = flipMap(a, b), back = flipMap(b, a);
  for (std::size_t i = 0; i < there.pixels.size(); ++i) ASSERT_NEAR(there.pixels[i], back.pixels[i], 1e-6f) << i;
}

TEST(Flip, OneDifferingPixelReachesJustAsFarAsTheFilterRadius) {
  for (float ppd : {20.f, kDefaultPixelsPerDegree}) {
    const int radius = colorFilterRadius(ppd), centre = 2 * radius, size = 2 * centre + 1;
    const base::Image reference = makeNoise(size, size, 4);
    base::Image test = reference;
    float* pixel = test.at(centre, centre);
    for (int c = 0; c < 3; ++c) pixel[c] = pixel[c] < 0.5f ? 1.f : 0.f;
    const base::Image map = flipMap(reference, test, {.ppd = ppd});
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const int distance = std::max(std::abs(x - centre), std::abs(y - centre));
        if (distance > radius) {
          ASSERT_EQ(*map.at(x, y), 0.f) << x << ", " << y;
        }
      }
    EXPECT_GT(*map.at(centre + radius, centre), 0.f);
    EXPECT_GT(*map.at(centre, centre - radius), 0.f);
    EXPECT_GT(*map.at(centre, centre), 0.01f);
  }
}

TEST(Flip, MirroredImagesGiveTheMirroredMap) {
  const auto mirror = [](const base::Image& image) {
    base::Image out = image;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < image.channels; ++c) out.at(x, y)[c] = image.at(image.width - 1 - x, y)[c];
    return out;
  };
  const base::Image a = makeNoise(45, 30, 5), b = makeNoise(45, 30, 6);
  EXPECT_EQ(flipMap(mirror(a), mirror(b)), mirror(flipMap(a, b)));
}

TEST(Flip, TheMapDoesNotDependOnThreadsOrRepetition) {
  const base::Image a = makeNoise(600, 530, 7), b = makeNoise(600, 530, 8); // 9 tiles
  base::Image first;
  for (int threads : {1, 2, 3, 8, 1}) {
    const base::ThreadLimit limit(threads);
    const base::Image map = flipMap(a, b);
    if (first.empty()) first = map;
    ASSERT_EQ(map, first) << threads;
  }
}

TEST(Flip, UnlikeImagesAreNotComparable) {
  const base::Image image(8, 8, 3);
  for (const base::Image& other :
       {base::Image(8, 9, 3), base::Image(9, 8, 3), base::Image(8, 8, 4), base::Image(8, 8, 1), base::Image()}) {
    EXPECT_EQ(errorOf([&] { flipMap(image, other); }).code(), base::ExitCode::notComparable);
    EXPECT_EQ(errorOf([&] { flipMap(other, image); }).code(), base::ExitCode::notComparable);
  }
  for (int channels : {1, 2, 5}) {
    const base::Image unusable(8, 8, channels);
    EXPECT_EQ(errorOf([&] { flipMap(unusable, unusable); }).code(), base::ExitCode::notComparable);
  }
}

TEST(Flip, NonFinitePixelsAreAnErrorWithCountAndFirstPosition) {
  const base::Image good = makeFlat(8, 8, 0, 0, 0);
  for (float bad : {kNan, kInf, -kInf}) {
    base::Image image = good;
    image.at(3, 2)[1] = bad;
    image.at(3, 2)[2] = bad;
    image.at(1, 5)[0] = bad;
    const base::Error error = errorOf([&] { flipMap(image, good); });
    EXPECT_EQ(error.code(), base::ExitCode::failed);
    EXPECT_EQ(std::string(error.what()), "reference: x 3, y 2: 2 pixels are NaN or infinite, this is the first");
    EXPECT_EQ(errorOf([&] { flipMap(good, image); }).subject(), "test");
    EXPECT_EQ(errorOf([&] { flipMap(image, image); }).code(), base::ExitCode::failed);
  }
}

TEST(Flip, DistancesOutsideTheRangeAreAUsageError) {
  const base::Image image(4, 4, 3);
  for (float ppd : {0.f, -1.f, 0.99f, 1001.f, kNan, kInf}) {
    EXPECT_EQ(errorOf([&] { flipMap(image, image, {.ppd = ppd}); }).code(), base::ExitCode::usage) << ppd;
  }
  EXPECT_EQ(errorOf([] { pixelsPerDegree(0.7f, 0.f, 0.7f); }).code(), base::ExitCode::usage);
  EXPECT_EQ(errorOf([] { pixelsPerDegree(kNan, 100.f, 0.7f); }).code(), base::ExitCode::usage);
}

TEST(Flip, BothEndsOfTheDistanceRangeGiveFiniteMaps) {
  const base::Image a = makeNoise(12, 9, 9), b = makeNoise(12, 9, 10);
  for (float ppd : {kMinPixelsPerDegree, kMaxPixelsPerDegree})
    for (float v : flipMap(a, b, {.ppd = ppd}).pixels) ASSERT_TRUE(v >= 0.f && v <= 1.f) << ppd;
}

} // namespace
} // namespace parity::compare
