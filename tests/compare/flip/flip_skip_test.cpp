// What FLIP leaves out: equal parts are not filtered, regions are computed alone; and neither changes a pixel nor hides
// a NaN.
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "compare/flip/flip.h"
#include "compare/flip/flip_filters.h"
#include "compare/flip/flip_hdr.h"
#include "flip_oracle.h"
#include "random_images.h"

namespace parity::compare {
namespace {

using test::Kind, test::makeImage;

// The pixels of `image` further than `radius` from any that differs from `other`.
std::uint64_t countBeyondReach(const base::Image& image, const base::Image& other, int radius) {
  std::uint64_t count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      bool reached = false;
      for (int v = std::max(0, y - radius); v <= std::min(image.height - 1, y + radius) && !reached; ++v)
        for (int u = std::max(0, x - radius); u <= std::min(image.width - 1, x + radius) && !reached; ++u)
          reached = !std::equal(image.at(u, v), image.at(u, v) + 3, other.at(u, v));
      count += !reached;
    }
  return count;
}

TEST(FlipSkip, EqualPartsAreNotFilteredAndTheRestIsTheOracles) {
  const base::Image reference = makeImage(Kind::noise, 360, 120, 1);
  base::Image test = reference;
  for (int y = 40; y < 60; ++y)
    for (int x = 314; x < 326; ++x) test.at(x, y)[1] = 0.5f; // across the seam of two tiles
  test.at(3, 100)[0] = 0.9f;
  const FlipMaps maps = flipMaps(reference, test);
  const std::vector<double> exact = oracle::flip(reference, test, static_cast<double>(kDefaultPixelsPerDegree)).flip;
  for (std::size_t i = 0; i < exact.size(); ++i)
    ASSERT_NEAR(static_cast<double>(maps.flip.pixels[i]), exact[i], 1e-4) << i;
  const std::uint64_t reached =
      reference.pixelCount() - countBeyondReach(reference, test, colorFilterRadius(FlipOptions{}.ppd));
  EXPECT_GE(maps.filteredPixels, reached);
  // Whole blocks of 16 x 16 with their surroundings are taken: here not even three times what is reached.
  EXPECT_LT(maps.filteredPixels, 3 * reached);
  EXPECT_EQ(flipMaps(reference, reference).filteredPixels, 0u);
}

// Few changes at random, in corners, and where blocks and tiles meet: none is overlooked.
TEST(FlipSkip, SparseChangesAnywhereGiveTheOraclesMap) {
  std::mt19937 random(31);
  const int sizes[][2] = {{600, 9}, {321, 40}, {33, 70}, {64, 64}, {300, 20}};
  for (unsigned round = 0; round < 40; ++round) {
    const auto& [width, height] = sizes[round % std::size(sizes)];
    const float ppd = std::array{1.f, 10.f, kDefaultPixelsPerDegree, 200.f}[round / 5 % 4];
    const base::Image reference = makeImage(Kind::noise8, width, height, round);
    base::Image test = reference;
    const int places[][2] = {{0, 0},  {width - 1, 0}, {0, height - 1}, {width - 1, height - 1},
                             {31, 4}, {32, 5},        {319, 15},       {320, 16},
                             {7, 7},  {8, 8},         {width / 2, 3},  {static_cast<int>(random() % 600), 6}};
    for (unsigned change = 0; change <= round % 3; ++change) {
      const auto& [x, y] = places[random() % std::size(places)];
      float* pixel = test.at(std::min(x, width - 1), std::min(y, height - 1));
      pixel[random() % 3] = static_cast<float>(random() % 256) / 255.f;
    }
    const base::Image map = flipMap(reference, test, {.ppd = ppd});
    const std::vector<double> exact = oracle::flip(reference, test, static_cast<double>(ppd)).flip;
    for (std::size_t i = 0; i < exact.size(); ++i)
      ASSERT_NEAR(static_cast<double>(map.pixels[i]), exact[i], 2e-5)
          << "round " << round << ", x " << i % static_cast<std::size_t>(width) << ", y "
          << i / static_cast<std::size_t>(width);
  }
}

TEST(FlipSkip, ARegionIsTheWholesPixelsAndNothingElse) {
  const base::Image reference = makeImage(Kind::noise, 301, 280, 5), test = makeImage(Kind::noise, 301, 280, 6);
  const base::Image hdrReference = test::makeHdrImage(301, 280, 7), hdrTest = test::makeHdrImage(301, 280, 9);
  const base::Image whole = flipMap(reference, test);
  const HdrFlip hdrWhole = flipHdr(hdrReference, hdrTest);
  for (const Rect& region :
       {Rect{0, 0, 301, 280}, Rect{0, 0, 1, 1}, Rect{300, 279, 1, 1}, Rect{17, 33, 50, 41}, Rect{200, 250, 101, 30}}) {
    const FlipMaps part = flipMaps(reference, test, {.region = region});
    const HdrFlip hdr = flipHdr(hdrReference, hdrTest, {.region = region});
    EXPECT_EQ(part.filteredPixels,
              static_cast<std::uint64_t>(region.width) * static_cast<std::uint64_t>(region.height));
    for (int y = 0; y < 280; ++y)
      for (int x = 0; x < 301; ++x) {
        const bool inside =
            x >= region.x && x < region.x + region.width && y >= region.y && y < region.y + region.height;
        ASSERT_EQ(*part.flip.at(x, y), inside ? *whole.at(x, y) : 0.f) << x << ", " << y;
        ASSERT_EQ(*hdr.flip.at(x, y), inside ? *hdrWhole.flip.at(x, y) : 0.f) << x << ", " << y;
      }
  }
}

TEST(FlipSkip, ARegionThatIsEmptyOrLeavesTheImageIsAUsageError) {
  const base::Image image(20, 10, 3);
  for (const Rect& region :
       {Rect{0, 0, 0, 5}, Rect{0, 0, 5, -1}, Rect{-1, 0, 5, 5}, Rect{0, 6, 5, 5}, Rect{16, 0, 5, 5},
        Rect{std::numeric_limits<int>::max(), 0, 5, 5}, Rect{5, 0, std::numeric_limits<int>::max(), 5}}) {
    SCOPED_TRACE(testing::Message() << region.x << "," << region.y << "," << region.width << "," << region.height);
    base::expectError([&] { flipMap(image, image, {.region = region}); }, {}, base::ExitCode::usage);
  }
}

TEST(FlipSkip, ANanInEqualPartsIsStillFound) {
  base::Image image = makeImage(Kind::noise, 100, 60, 8);
  image.at(77, 41)[2] = std::numeric_limits<float>::quiet_NaN();
  const auto messageOf = [](auto call) { return base::expectError(call, {}); };
  const std::string expected = "reference: x 77, y 41: 1 pixel is NaN or infinite, this is the first";
  EXPECT_EQ(messageOf([&] { flipMap(image, image); }), expected);
  EXPECT_EQ(messageOf([&] { flipHdr(image, image); }), expected);
  // In the margin of a region, which the filters reach, but not beyond it.
  EXPECT_EQ(messageOf([&] { flipMap(image, image, {.region = Rect{60, 30, 8, 8}}); }), expected);
  EXPECT_NO_THROW(flipMap(image, image, {.region = Rect{60, 30, 7, 8}}));
}

// Rows further apart than they are long, upside down, and a fourth channel: only the pixels count.
TEST(FlipSkip, StridesAndAFourthChannelChangeNothing) {
  const base::Image a = makeImage(Kind::noise8, 67, 35, 10), b = makeImage(Kind::noise8, 67, 35, 11);
  const base::Image expected = flipMap(a, b);
  const auto widen = [](const base::Image& image, float filler) {
    base::Image wide(image.width + 9, image.height, 4, filler);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) std::copy_n(image.at(x, image.height - 1 - y), 3, wide.at(x, y));
    return wide;
  };
  const base::Image wideA = widen(a, 0.25f), wideB = widen(b, 0.75f);
  const auto flipped = [](const base::Image& wide) {
    PixelView view(wide);
    view.width -= 9;
    view.floats += (wide.height - 1) * view.stride;
    view.stride = -view.stride;
    return view;
  };
  EXPECT_EQ(flipMap(flipped(wideA), flipped(wideB)), expected);

  base::Image8 bytesA(67, 35, 3), bytesB(67, 35, 3);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    bytesA.pixels[i] = static_cast<std::uint8_t>(std::lround(255.f * a.pixels[i]));
    bytesB.pixels[i] = static_cast<std::uint8_t>(std::lround(255.f * b.pixels[i]));
  }
  const base::Image fromBytes = flipMap(bytesA, bytesB);
  for (std::size_t i = 0; i < expected.pixels.size(); ++i)
    ASSERT_NEAR(fromBytes.pixels[i], expected.pixels[i], 1e-5f) << i; // i/255 and i*(1/255) differ in the last bit
}

} // namespace
} // namespace parity::compare
