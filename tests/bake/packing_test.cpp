// Rectangles and charts in their pages: none over another, none beyond the page, little between them.
#include "bake/atlas/packing.h"

#include <random>

#include <gtest/gtest.h>

namespace parity::tests {
namespace {

using bake::Rectangle;

std::vector<Rectangle> randomSizes(std::size_t count, int largest, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Rectangle> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    const int width = 1 + static_cast<int>(random() % static_cast<unsigned>(largest));
    sizes.push_back({{width, 1 + static_cast<int>(random() % static_cast<unsigned>(largest))}});
  }
  return sizes;
}

// Texels covered; -1 where two rectangles share one or one lies beyond its page.
long coveredTexels(const bake::Packing& packing, const std::vector<Rectangle>& sizes) {
  const std::size_t area = static_cast<std::size_t>(packing.width) * packing.height;
  std::vector<bool> taken(area * static_cast<std::size_t>(packing.pages), false);
  long covered = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const glm::ivec2 corner = packing.corners[i];
    if (corner.x < 0 || corner.y < 0 || corner.x + sizes[i].size.x > packing.width ||
        corner.y + sizes[i].size.y > packing.height || packing.page[i] < 0 || packing.page[i] >= packing.pages)
      return -1;
    for (int y = corner.y; y < corner.y + sizes[i].size.y; ++y)
      for (int x = corner.x; x < corner.x + sizes[i].size.x; ++x, ++covered) {
        const std::size_t texel = packing.page[i] * area + static_cast<std::size_t>(y) * packing.width + x;
        if (taken[texel]) return -1;
        taken[texel] = true;
      }
  }
  return covered;
}

TEST(Packing, FillsMostOfAPage) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<Rectangle> sizes = randomSizes(300, 60, seed);
    const std::optional<bake::Packing> page = bake::packPage(sizes, 2048);
    ASSERT_TRUE(page);
    EXPECT_EQ(page->pages, 1);
    EXPECT_EQ(page->width, page->height);
    EXPECT_EQ(page->width % 4, 0);
    const double area = static_cast<double>(page->width) * page->height;
    EXPECT_GE(static_cast<double>(coveredTexels(*page, sizes)), 0.85 * area);
    const bake::Packing tight = bake::packTight(sizes);
    EXPECT_GE(static_cast<double>(coveredTexels(tight, sizes)), 0.85 * tight.width * tight.height);
    EXPECT_LE(std::abs(tight.width - tight.height), tight.width / 3);
  }
}

TEST(Packing, TakesAsManyPagesAsNeededAndNoLarger) {
  const std::vector<Rectangle> sizes = randomSizes(300, 60, 7);
  EXPECT_FALSE(bake::packPage(sizes, 256));
  const bake::Packing packing = bake::packPages(sizes, 256);
  EXPECT_GT(coveredTexels(packing, sizes), 0);
  long area = 0;
  for (const Rectangle& rectangle : sizes) area += static_cast<long>(rectangle.size.x) * rectangle.size.y;
  EXPECT_EQ(packing.pages, static_cast<int>(area / (256L * 256)) + 1);
  EXPECT_LE(packing.width, 256);
}

TEST(Packing, PlacesWhatFitsExactly) {
  const std::vector<Rectangle> sizes(64, Rectangle{{16, 16}});
  const std::optional<bake::Packing> page = bake::packPage(sizes, 128);
  ASSERT_TRUE(page);
  EXPECT_EQ(page->width, 128);
  EXPECT_EQ(coveredTexels(*page, sizes), 128 * 128);
  EXPECT_FALSE(bake::packPage({{{129, 1}}}, 128));
}

bake::FlatChart triangleChart(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  bake::FlatChart chart;
  chart.faces = {0};
  chart.corners = {{a, b, c}};
  chart.size = glm::ivec2(glm::ceil(glm::max(glm::max(a, b), c)));
  return chart;
}

TEST(Profile, HoldsEveryTexelThatATriangleTouches) {
  const bake::FlatChart chart = triangleChart({0, 0}, {4, 2}, {0, 4});
  const bake::Profile bare = bake::makeProfile(chart, 0);
  // y from x / 2 to 4 - x / 2: within column x from its left side.
  EXPECT_EQ(bare.low, (std::vector<std::uint16_t>{0, 0, 1, 1}));
  EXPECT_EQ(bare.high, (std::vector<std::uint16_t>{4, 4, 3, 3}));
  const bake::Profile padded = bake::makeProfile(chart, 2);
  EXPECT_EQ(padded.low, (std::vector<std::uint16_t>{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(padded.high, (std::vector<std::uint16_t>{6, 6, 6, 6, 5, 5}));
}

TEST(Profile, LetsChartsReachIntoEachOther) {
  // Two halves of a square of 64, below and above its diagonal: by rectangles they need twice the square.
  const bake::Profile first = bake::makeProfile(triangleChart({0, 0}, {64, 0}, {0, 64}), 0);
  const bake::Profile second = bake::makeProfile(triangleChart({64, 0}, {64, 64}, {0, 64}), 0);
  bake::Horizon page(64, 128);
  EXPECT_EQ(page.place({64, 64}, first), glm::ivec2(0, 0));
  // Steps of one texel meet on the diagonal, where both touch every texel.
  EXPECT_EQ(page.place({64, 64}, second), glm::ivec2(0, 1));
  EXPECT_EQ(page.usedHeight(), 65);
  EXPECT_FALSE(page.place({64, 64}, first));
  EXPECT_FALSE(page.place({65, 1}, first));
}

} // namespace
} // namespace parity::tests
