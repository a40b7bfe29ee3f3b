// Distances against a search through all sources.
#include "bake/encode/distance_transform.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "base/parallel.h"

namespace parity::bake {
namespace {

base::BasicImage<std::int32_t> search(const base::Image8& sources) {
  base::BasicImage<std::int32_t> distances(sources.width, sources.height, 1, kNoSource);
  for (int y = 0; y < sources.height; ++y)
    for (int x = 0; x < sources.width; ++x)
      for (int v = 0; v < sources.height; ++v)
        for (int u = 0; u < sources.width; ++u)
          if (*sources.at(u, v) != 0)
            *distances.at(x, y) = std::min(*distances.at(x, y), (x - u) * (x - u) + (y - v) * (y - v));
  return distances;
}

TEST(DistanceTransform, IsExactOnRandomMasks) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const int width = 1 + static_cast<int>(random() % 40), height = 1 + static_cast<int>(random() % 40);
    base::Image8 sources(width, height, 1);
    const unsigned rarity = 1u << (random() % 11);
    for (std::uint8_t& pixel : sources.pixels) pixel = random() % rarity == 0 ? 1 + random() % 255 : 0;
    ASSERT_EQ(squaredDistances(sources), search(sources)) << width << " x " << height << " 1 in " << rarity;
  }
}

TEST(DistanceTransform, ReachesAcrossTheLargestSides) {
  base::Image8 sources(base::kMaxImageSide, 3, 1);
  *sources.at(0, 0) = 1;
  const auto distances = squaredDistances(sources);
  const std::int32_t far = base::kMaxImageSide - 1;
  EXPECT_EQ(*distances.at(far, 2), far * far + 4);
  base::Image8 tall(3, base::kMaxImageSide, 1);
  *tall.at(2, 0) = 1;
  EXPECT_EQ(*squaredDistances(tall).at(0, far), far * far + 4);
}

TEST(DistanceTransform, IsNowhereWithoutSources) {
  const auto distances = squaredDistances(base::Image8(7, 5, 1));
  EXPECT_TRUE(std::all_of(distances.pixels.begin(), distances.pixels.end(), [](auto d) { return d == kNoSource; }));
}

TEST(DistanceTransform, IsTheSameForAnyNumberOfThreads) {
  std::mt19937 random(5);
  base::Image8 sources(333, 200, 1);
  for (std::uint8_t& pixel : sources.pixels) pixel = random() % 500 == 0;
  const auto all = squaredDistances(sources);
  const base::ThreadLimit one(1);
  EXPECT_EQ(squaredDistances(sources), all);
}

} // namespace
} // namespace parity::bake
