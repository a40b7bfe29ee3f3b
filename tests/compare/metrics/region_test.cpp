// Regions as runs, and where they lie.
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "compare/pooling/region.h"
#include "compare/pooling/region_runs.h"

namespace parity::compare {
namespace {

TEST(WholeImage, IsEveryPixelOnce) {
  const base::PixelList list = wholeImage(5, 3);
  ASSERT_EQ(list.pixels.size(), 15u);
  for (std::uint32_t i = 0; i < 15; ++i) EXPECT_EQ(list.pixels[i], i);
  EXPECT_TRUE(list.weights.empty());
}

TEST(Runs, AreNeighboursOfOneRow) {
  const RegionRuns runs = runsOf({"m", {1, 2, 3, 4, 5, 9, 11, 12}, {}}, 5, 3);
  ASSERT_EQ(runs.runs.size(), 4u) << "1..4, 5, 9, 11..12";
  EXPECT_EQ(runs.runs[0].first, 1u);
  EXPECT_EQ(runs.runs[0].count, 4u);
  EXPECT_EQ(runs.runs[1].first, 5u) << "the next row";
  EXPECT_EQ(runs.runs[1].count, 1u);
  EXPECT_EQ(runs.runs[2].first, 9u);
  EXPECT_EQ(runs.runs[3].count, 2u);
  EXPECT_EQ(runs.pixels, 8u);
  EXPECT_EQ(runs.weight, 8);
}

// On random lists: the runs hold each pixel of weight above 0 with its own weight, in order, and nothing else.
TEST(Runs, HoldEachPixelWithItsWeight) {
  std::mt19937 random(5);
  std::size_t held = 0;
  for (int round = 0; round < 200; ++round) {
    const int width = 1 + static_cast<int>(random() % 20), height = 1 + static_cast<int>(random() % 20);
    base::PixelList list{"m", {}, {}};
    std::vector<std::pair<std::uint32_t, float>> expected;
    double weight = 0;
    for (std::uint32_t pixel = 0; pixel < static_cast<std::uint32_t>(width * height); ++pixel) {
      if (random() % 4 == 0) continue;
      list.pixels.push_back(pixel);
      list.weights.push_back(static_cast<float>(random() % 4) / 4.f);
      if (list.weights.back() > 0) expected.emplace_back(pixel, list.weights.back());
      weight += static_cast<double>(list.weights.back());
    }
    const RegionRuns runs = runsOf(list, width, height);
    std::vector<std::pair<std::uint32_t, float>> found;
    for (const auto& run : runs.runs) {
      EXPECT_EQ(run.first / static_cast<std::uint32_t>(width),
                (run.first + run.count - 1) / static_cast<std::uint32_t>(width));
      for (std::uint32_t i = 0; i < run.count; ++i) found.emplace_back(run.first + i, runs.weightsOf(run)[i]);
    }
    ASSERT_EQ(found, expected) << width << " x " << height;
    EXPECT_EQ(runs.pixels, expected.size());
    EXPECT_EQ(runs.weight, weight);
    held += found.size();
  }
  EXPECT_GT(held, 5000u);
}

TEST(Runs, MalformedListsAreErrors) {
  EXPECT_THROW(runsOf({"m", {4}, {}}, 2, 2), base::Error);
  EXPECT_THROW(runsOf({"m", {3, 1}, {}}, 2, 2), base::Error);
  EXPECT_TRUE(runsOf({"m", {}, {}}, 2, 2).runs.empty());
}

TEST(Bounds, HoldAllListsAndTheMarginWithinTheImage) {
  const base::PixelList a{"a", {12, 33}, {}}, b{"b", {57}, {}}, none{"none", {}, {}};
  const base::PixelList *both[] = {&a, &none, &b}, *nothing[] = {&none};
  EXPECT_EQ(boundsOf(both, 10, 10), (Rect{2, 1, 6, 5}));
  EXPECT_EQ(boundsOf(both, 10, 10, 3), (Rect{0, 0, 10, 9}));
  EXPECT_TRUE(boundsOf(nothing, 10, 10, 3).empty());
}

} // namespace
} // namespace parity::compare
