// FLIP of swapped pictures against flipMap of the same pictures made whole: bit by bit the same at the lists' pixels.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/gathered.h"
#include "base/parallel.h"
#include "base/simd_level.h"
#include "compare/flip/flip_hdr.h"
#include "compare/flip/flip_swap.h"
#include "compare/metrics/error_code.h"
#include "random_images.h"

namespace parity::compare {
namespace {

constexpr int kWidth = 371, kHeight = 283; // beyond a tile either way

struct List {
  const char* what;
  std::vector<std::uint32_t> pixels;
};

std::vector<std::uint32_t> boxOf(int x0, int y0, int x1, int y1) {
  std::vector<std::uint32_t> pixels;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) pixels.push_back(static_cast<std::uint32_t>(y * kWidth + x));
  return pixels;
}

std::vector<std::uint32_t> everyNth(std::uint32_t n, std::uint32_t first) {
  std::vector<std::uint32_t> pixels;
  for (std::uint32_t p = first; p < kWidth * kHeight; p += n) pixels.push_back(p);
  return pixels;
}

std::vector<List> makeLists() {
  return {
      {"all pixels", everyNth(1, 0)},          {"a box across tiles", boxOf(290, 240, 350, 270)},
      {"a corner", boxOf(0, 0, 20, 30)},       {"the other corner", boxOf(kWidth - 9, kHeight - 5, kWidth, kHeight)},
      {"thin rows", boxOf(10, 100, 290, 101)}, {"scattered", everyNth(97, 5)},
      {"one pixel", {150 * kWidth + 320}},     {"none", {}}};
}

// The values of an image at the pixels.
template <typename T>
base::BasicImage<T> gather(const base::BasicImage<T>& image, const std::vector<std::uint32_t>& pixels) {
  auto out = base::makeGathered<T>(pixels.size(), 3);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    std::copy_n(&image.pixels[3 * std::size_t{pixels[i]}], 3, &out.pixels[3 * i]);
  return out;
}

// `base` with the pixels of `other`.
template <typename T> base::BasicImage<T> swapPixels(base::BasicImage<T> base, const base::BasicImage<T>& other,
                                                     const std::vector<std::uint32_t>& pixels) {
  for (const std::uint32_t p : pixels)
    std::copy_n(&other.pixels[3 * std::size_t{p}], 3, &base.pixels[3 * std::size_t{p}]);
  return base;
}

base::Image8 toBytes(const base::Image& image) {
  base::Image8 out(image.width, image.height, 3);
  std::ranges::transform(image.pixels, out.pixels.begin(),
                         [](float v) { return static_cast<std::uint8_t>(std::clamp(v, 0.f, 1.f) * 255 + 0.5f); });
  return out;
}

template <typename T>
void expectAsWhole(const base::BasicImage<T>& reference, const base::BasicImage<T>& other, float ppd) {
  const std::vector<List> lists = makeLists();
  std::vector<base::BasicImage<T>> colors;
  std::vector<FlipSwap> swaps;
  for (const List& list : lists) colors.push_back(gather(other, list.pixels));
  for (std::size_t i = 0; i < lists.size(); ++i) swaps.push_back({lists[i].pixels, colors[i]});
  const auto found = flipSwaps(reference, swaps, ppd);
  ASSERT_EQ(found.size(), lists.size());
  for (std::size_t i = 0; i < lists.size(); ++i) {
    const base::Image map = flipMap(reference, swapPixels(reference, other, lists[i].pixels), {.ppd = ppd});
    ASSERT_EQ(found[i].size(), lists[i].pixels.size()) << lists[i].what;
    std::size_t wrong = 0, nonZero = 0;
    for (std::size_t k = 0; k < found[i].size(); ++k) {
      wrong += found[i][k] != map.pixels[lists[i].pixels[k]];
      nonZero += found[i][k] != 0;
    }
    EXPECT_EQ(wrong, 0u) << lists[i].what << ", ppd " << ppd;
    EXPECT_EQ(nonZero > 0, !lists[i].pixels.empty()) << lists[i].what;
  }
}

TEST(FlipSwap, BytesAreAsInTheWholePicture) {
  for (const test::Kind kind : {test::Kind::smooth, test::Kind::noise8, test::Kind::dark})
    expectAsWhole(toBytes(test::makeImage(kind, kWidth, kHeight, 1)),
                  toBytes(test::makeImage(kind, kWidth, kHeight, 2)), kDefaultPixelsPerDegree);
}

TEST(FlipSwap, FloatsAreAsInTheWholePicture) {
  expectAsWhole(test::makeImage(test::Kind::smooth, kWidth, kHeight, 3),
                test::makeImage(test::Kind::noise, kWidth, kHeight, 4), kDefaultPixelsPerDegree);
}

TEST(FlipSwap, OtherFilterSizesAreAsInTheWholePicture) {
  for (const float ppd : {20.f, 160.f})
    expectAsWhole(toBytes(test::makeImage(test::Kind::smooth, kWidth, kHeight, 5)),
                  toBytes(test::makeImage(test::Kind::noise8, kWidth, kHeight, 6)), ppd);
}

TEST(FlipSwap, EveryInstructionSetIsAsItsOwnWholePicture) {
  for (const std::string& level : base::simdLevels()) {
    base::useSimdLevel(level);
    expectAsWhole(toBytes(test::makeImage(test::Kind::smooth, kWidth, kHeight, 7)),
                  toBytes(test::makeImage(test::Kind::noise8, kWidth, kHeight, 8)), kDefaultPixelsPerDegree);
  }
  base::useSimdLevel("");
}

TEST(FlipSwap, WhatIsEqualIsZeroHoweverManyOthersDiffer) {
  const base::Image8 reference = toBytes(test::makeImage(test::Kind::smooth, kWidth, kHeight, 9));
  const base::Image8 other = toBytes(test::makeImage(test::Kind::noise8, kWidth, kHeight, 10));
  const std::vector<std::uint32_t> even = everyNth(2, 0), odd = everyNth(2, 1);
  const base::Image8 same = gather(reference, even), differs = gather(other, odd);
  const std::vector<FlipSwap> swaps = {{even, same}, {odd, differs}};
  const auto found = flipSwaps(reference, swaps, kDefaultPixelsPerDegree);
  EXPECT_EQ(*std::ranges::max_element(found[0]), 0) << "the neighbours' differences bleed in";
  EXPECT_GT(*std::ranges::max_element(found[1]), 0.1f);
}

// Its neighbours in the list are equal, but within the filters' reach: also across blocks, batches and tiles.
TEST(FlipSwap, OnePixelThatDiffersReachesAllAroundIt) {
  const base::Image8 reference = toBytes(test::makeImage(test::Kind::smooth, kWidth, kHeight, 17));
  const std::vector<std::uint32_t> all = everyNth(1, 0);
  for (const std::uint32_t pixel : {64u * kWidth + 64, 63u * kWidth + 95, 256u * kWidth + 320, 255u * kWidth + 319}) {
    base::Image8 other = reference;
    for (std::size_t c = 0; c < 3; ++c) other.pixels[3 * std::size_t{pixel} + c] ^= 0x80;
    const base::Image8 colors = gather(other, all);
    const FlipSwap swap{all, colors};
    EXPECT_EQ(flipSwaps(reference, {&swap, 1}, kDefaultPixelsPerDegree)[0], flipMap(reference, other).pixels) << pixel;
  }
}

TEST(FlipSwap, DoesNotDependOnTheNumberOfThreads) {
  const base::Image8 reference = toBytes(test::makeImage(test::Kind::noise8, kWidth, kHeight, 11)),
                     other = toBytes(test::makeImage(test::Kind::noise8, kWidth, kHeight, 12));
  const std::vector<std::uint32_t> pixels = everyNth(3, 0);
  const base::Image8 colors = gather(other, pixels);
  const FlipSwap swap{pixels, colors};
  const auto many = flipSwaps(reference, {&swap, 1}, kDefaultPixelsPerDegree);
  const base::ThreadLimit one(1);
  EXPECT_EQ(flipSwaps(reference, {&swap, 1}, kDefaultPixelsPerDegree), many);
}

TEST(FlipSwap, HdrIsAsInTheWholePicture) {
  const base::Image reference = test::makeHdrImage(kWidth, kHeight, 13),
                    other = test::makeHdrImage(kWidth, kHeight, 15);
  const std::vector<std::uint32_t> box = boxOf(30, 40, 120, 90), scattered = everyNth(53, 1);
  const base::Image colors[] = {gather(other, box), gather(other, scattered)};
  const std::vector<FlipSwap> swaps = {{box, colors[0]}, {scattered, colors[1]}};
  const auto found = flipHdrSwaps(reference, swaps);
  for (std::size_t i = 0; i < swaps.size(); ++i) {
    const std::vector<std::uint32_t>& pixels = i == 0 ? box : scattered;
    const base::Image map = flipHdr(reference, swapPixels(reference, other, pixels)).flip;
    for (std::size_t k = 0; k < pixels.size(); ++k) ASSERT_EQ(found[i][k], map.pixels[pixels[k]]) << k;
  }
}

TEST(FlipSwap, HdrOfABlackReferenceHasTheExposuresOfTheSwap) {
  const base::Image black(64, 48, 3);
  const std::vector<std::uint32_t> pixels = {100, 101, 102, 164, 165};
  base::Image colors = base::makeGathered<float>(pixels.size(), 3);
  std::ranges::fill(colors.pixels, 0.5f);
  const FlipSwap swap{pixels, colors};
  const auto found = flipHdrSwaps(black, {&swap, 1});
  for (const float value : found[0]) EXPECT_GT(value, 0.1f);
}

TEST(FlipSwap, RefusesWhatDoesNotFit) {
  const base::Image8 reference(64, 48, 3, 100);
  const std::vector<std::uint32_t> pixels = {5, 6}, beyond = {5, 64 * 48}, backwards = {6, 5};
  const base::Image8 colors = base::makeGathered<std::uint8_t>(2, 3), few = base::makeGathered<std::uint8_t>(1, 3);
  const base::Image floats = base::makeGathered<float>(2, 3);
  const auto codeOf = [&](const FlipSwap& swap) {
    return test::codeOf([&] { flipSwaps(reference, {&swap, 1}, kDefaultPixelsPerDegree); });
  };
  EXPECT_EQ(codeOf({pixels, colors}), base::ExitCode::withinBudget);
  EXPECT_EQ(codeOf({pixels, few}), base::ExitCode::notComparable);
  EXPECT_EQ(codeOf({pixels, floats}), base::ExitCode::notComparable);
  EXPECT_EQ(codeOf({beyond, colors}), base::ExitCode::failed);
  EXPECT_EQ(codeOf({backwards, colors}), base::ExitCode::failed);
  const FlipSwap good{pixels, colors};
  EXPECT_EQ(test::codeOf([&] { flipSwaps(reference, {&good, 1}, 0.5f); }), base::ExitCode::usage);
}

} // namespace
} // namespace parity::compare
