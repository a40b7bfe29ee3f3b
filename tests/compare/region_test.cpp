// The interior of a region: what erosion keeps; and where regions lie.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "compare/region.h"

namespace parity::compare {
namespace {

base::PixelList listOf(const std::vector<bool>& mask) {
  base::PixelList list;
  list.name = "mask";
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (mask[i]) list.pixels.push_back(static_cast<std::uint32_t>(i));
  return list;
}

// The definition, pixel by pixel.
std::vector<std::uint32_t> erodePlainly(const std::vector<bool>& mask, int width, int height, int radius) {
  std::vector<std::uint32_t> kept;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      bool inside = true;
      for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v)
        for (int u = std::max(0, x - radius); u <= std::min(width - 1, x + radius); ++u)
          inside = inside && mask[static_cast<std::size_t>(v * width + u)];
      if (inside) kept.push_back(static_cast<std::uint32_t>(y * width + x));
    }
  return kept;
}

TEST(Erode, keepsWhatTheDefinitionKeepsOnRandomMasks) {
  std::mt19937 random(5);
  int kept = 0;
  for (int round = 0; round < 400; ++round) {
    const int width = 1 + static_cast<int>(random() % 40), height = 1 + static_cast<int>(random() % 40);
    const int radius = static_cast<int>(random() % 6);
    std::vector<bool> mask(static_cast<std::size_t>(width * height), round % 2 == 0);
    const auto point = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
    for (int shape = 0; shape < 4; ++shape) { // rectangles set or cut out
      const int x0 = point(width), y0 = point(height), x1 = x0 + point(width), y1 = y0 + point(height);
      for (int y = y0; y <= std::min(y1, height - 1); ++y)
        for (int x = x0; x <= std::min(x1, width - 1); ++x)
          mask[static_cast<std::size_t>(y * width + x)] = round % 2 != 0 || shape > 2;
    }
    const std::vector<std::uint32_t> expected = erodePlainly(mask, width, height, radius);
    ASSERT_EQ(erode(listOf(mask), width, height, radius).pixels, expected)
        << width << " x " << height << ", radius " << radius;
    kept += static_cast<int>(expected.size());
  }
  EXPECT_GT(kept, 10000); // the masks are no trivial ones
}

TEST(Erode, imageBordersDoNotErode) {
  EXPECT_EQ(erode(wholeImage(5, 3), 5, 3, 10).pixels.size(), 15u);
  EXPECT_EQ(erode(wholeImage(1, 1), 1, 1, 10).pixels.size(), 1u);
}

TEST(Erode, aSquareLosesTheRadiusOnEachSide) {
  std::vector<bool> mask(40 * 40);
  for (std::size_t y = 5; y < 35; ++y)
    for (std::size_t x = 5; x < 35; ++x) mask[y * 40 + x] = true;
  const base::PixelList interior = erode(listOf(mask), 40, 40, 10);
  EXPECT_EQ(interior.pixels.size(), 100u);
  EXPECT_EQ(interior.pixels.front(), 15u * 40 + 15);
  EXPECT_EQ(interior.pixels.back(), 24u * 40 + 24);
}

TEST(Erode, weightsStayWithTheirPixelsAndWeightlessOnesErode) {
  base::PixelList list = wholeImage(9, 1);
  list.name = "named";
  for (std::uint32_t pixel : list.pixels) list.weights.push_back(static_cast<float>(pixel + 1) / 16.f);
  list.weights[2] = 0;
  const base::PixelList interior = erode(list, 9, 1, 1);
  EXPECT_EQ(interior.name, "named");
  EXPECT_EQ(interior.pixels, (std::vector<std::uint32_t>{0, 4, 5, 6, 7, 8}));
  EXPECT_EQ(interior.weights, (std::vector<float>{1 / 16.f, 5 / 16.f, 6 / 16.f, 7 / 16.f, 8 / 16.f, 9 / 16.f}));
}

TEST(Erode, malformedListsAreErrors) {
  EXPECT_THROW(erode({"m", {4}, {}}, 2, 2, 1), base::Error);
  EXPECT_THROW(erode({"m", {3, 1}, {}}, 2, 2, 1), base::Error);
  EXPECT_TRUE(erode({"m", {}, {}}, 2, 2, 1).pixels.empty());
}

TEST(Bounds, holdAllListsAndTheMarginWithinTheImage) {
  const base::PixelList a{"a", {12, 33}, {}}, b{"b", {57}, {}}, none{"none", {}, {}};
  const base::PixelList *both[] = {&a, &none, &b}, *nothing[] = {&none};
  EXPECT_EQ(boundsOf(both, 10, 10), (Rect{2, 1, 6, 5}));
  EXPECT_EQ(boundsOf(both, 10, 10, 3), (Rect{0, 0, 10, 9}));
  EXPECT_TRUE(boundsOf(nothing, 10, 10, 3).empty());
}

} // namespace
} // namespace parity::compare
