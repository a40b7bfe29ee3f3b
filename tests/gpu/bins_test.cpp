// Bins and pixel lists from pictures of ids.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "base/parallel.h"
#include "gpu/surface/bins.h"

namespace parity::gpu {
namespace {

std::vector<glm::uvec2> randomIds(std::size_t count, std::uint32_t instances) {
  std::mt19937 random(7);
  std::vector<glm::uvec2> ids(count);
  for (glm::uvec2& id : ids) id = {random() % (instances + 1), random() % 100};
  return ids;
}

TEST(Bins, HoldEveryCoveredPixelOnceInPixelOrderWithinItsBin) {
  const std::vector<std::uint32_t> keys = {2, 0, 2, 3, 0}; // key 1 has no instance
  const auto ids = randomIds(100'003, 5);
  const Bins bins = makeBins(ids, keys, 4);

  // The naive oracle: one pass over the picture per key.
  std::vector<std::uint32_t> expected;
  std::vector<Bin> expectedBins;
  for (std::uint32_t key = 0; key < 4; ++key) {
    const auto first = static_cast<std::uint32_t>(expected.size());
    for (std::uint32_t i = 0; i < ids.size(); ++i)
      if (ids[i].x != 0 && keys[ids[i].x - 1] == key) expected.push_back(i);
    if (expected.size() > first)
      expectedBins.push_back({key, first, static_cast<std::uint32_t>(expected.size()) - first});
  }
  EXPECT_EQ(bins.entries, expected);
  ASSERT_EQ(bins.bins.size(), expectedBins.size());
  for (std::size_t b = 0; b < expectedBins.size(); ++b) {
    EXPECT_EQ(bins.bins[b].key, expectedBins[b].key);
    EXPECT_EQ(bins.bins[b].first, expectedBins[b].first);
    EXPECT_EQ(bins.bins[b].count, expectedBins[b].count);
  }
}

TEST(Bins, DoNotDependOnTheNumberOfThreads) {
  const std::vector<std::uint32_t> keys = {0, 1, 2};
  const auto ids = randomIds(300'000, 3);
  const Bins all = makeBins(ids, keys, 3);
  const base::ThreadLimit one(1);
  EXPECT_EQ(makeBins(ids, keys, 3).entries, all.entries);
}

TEST(Bins, OrderedByBlocksHoldTheSamePixelsBlockAfterBlock) {
  constexpr std::uint32_t kWidth = 37;
  const std::vector<std::uint32_t> keys = {1, 0, 1};
  const auto ids = randomIds(std::size_t{kWidth} * 50 - 5, 3);
  const Bins inRows = makeBins(ids, keys, 2);
  Bins inBlocks = inRows;
  orderByBlocks(inBlocks, kWidth);
  for (const Bin& bin : inRows.bins) {
    std::vector<std::uint32_t> expected(inRows.entries.begin() + bin.first,
                                        inRows.entries.begin() + bin.first + bin.count);
    const auto blockOf = [](std::uint32_t p) {
      const std::uint32_t x = p % kWidth, y = p / kWidth;
      return std::tuple(y / kRegionSide, x / kRegionSide, y / kBlockSide, x / kBlockSide);
    };
    std::stable_sort(expected.begin(), expected.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return blockOf(a) < blockOf(b); });
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), inBlocks.entries.begin() + bin.first));
  }
}

TEST(Bins, OfAnEmptyPictureAreNone) {
  const std::vector<glm::uvec2> ids(1000, glm::uvec2(0));
  const Bins bins = makeBins(ids, std::vector<std::uint32_t>{0}, 1);
  EXPECT_TRUE(bins.bins.empty());
  EXPECT_TRUE(bins.entries.empty());
}

} // namespace
} // namespace parity::gpu
