// Rectangles in their pages: none over another, none beyond the page, little between them.
#include "bake/packing.h"

#include <random>

#include <gtest/gtest.h>

namespace parity::tests {
namespace {

std::vector<glm::ivec2> randomSizes(std::size_t count, int largest, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<glm::ivec2> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    const int width = 1 + static_cast<int>(random() % static_cast<unsigned>(largest));
    sizes.emplace_back(width, 1 + static_cast<int>(random() % static_cast<unsigned>(largest)));
  }
  return sizes;
}

// Texels covered; -1 where two rectangles share one or one lies beyond its page.
long coveredTexels(const bake::Packing& packing, const std::vector<glm::ivec2>& sizes) {
  const std::size_t area = static_cast<std::size_t>(packing.width) * packing.height;
  std::vector<bool> taken(area * static_cast<std::size_t>(packing.pages), false);
  long covered = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const glm::ivec2 corner = packing.corners[i];
    if (corner.x < 0 || corner.y < 0 || corner.x + sizes[i].x > packing.width ||
        corner.y + sizes[i].y > packing.height || packing.page[i] < 0 || packing.page[i] >= packing.pages)
      return -1;
    for (int y = corner.y; y < corner.y + sizes[i].y; ++y)
      for (int x = corner.x; x < corner.x + sizes[i].x; ++x, ++covered) {
        const std::size_t texel = packing.page[i] * area + static_cast<std::size_t>(y) * packing.width + x;
        if (taken[texel]) return -1;
        taken[texel] = true;
      }
  }
  return covered;
}

TEST(Packing, FillsMostOfAPage) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const std::vector<glm::ivec2> sizes = randomSizes(300, 60, seed);
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
  const std::vector<glm::ivec2> sizes = randomSizes(300, 60, 7);
  EXPECT_FALSE(bake::packPage(sizes, 256));
  const bake::Packing packing = bake::packPages(sizes, 256);
  EXPECT_GT(coveredTexels(packing, sizes), 0);
  long area = 0;
  for (const glm::ivec2& size : sizes) area += static_cast<long>(size.x) * size.y;
  EXPECT_EQ(packing.pages, static_cast<int>(area / (256L * 256)) + 1);
  EXPECT_LE(packing.width, 256);
}

TEST(Packing, PlacesWhatFitsExactly) {
  const std::vector<glm::ivec2> sizes(64, glm::ivec2(16, 16));
  const std::optional<bake::Packing> page = bake::packPage(sizes, 128);
  ASSERT_TRUE(page);
  EXPECT_EQ(page->width, 128);
  EXPECT_EQ(coveredTexels(*page, sizes), 128 * 128);
  EXPECT_FALSE(bake::packPage({{129, 1}}, 128));
}

} // namespace
} // namespace parity::tests
