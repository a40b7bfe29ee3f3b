// Dilation on pages small enough to work out by hand.
#include "bake/encode/dilation.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace parity::tests {
namespace {

using bake::kNoInstance;

bake::LightmapPage makePage(int width, int height) {
  bake::LightmapPage page;
  page.owner = {width, height, 1, kNoInstance};
  page.irradiance = {width, height, 3};
  page.sh = {width, height, 4};
  page.normal = {width, height, 3};
  return page;
}

void setTexel(bake::LightmapPage& page, int x, int y, std::uint32_t owner, float value, const glm::vec3& normal) {
  *page.owner.at(x, y) = owner;
  std::fill_n(page.irradiance.at(x, y), 3, value);
  std::fill_n(page.sh.at(x, y), 4, 2 * value);
  for (int c = 0; c < 3; ++c) page.normal.at(x, y)[c] = normal[c];
}

TEST(Dilation, FillsRingByRing) {
  bake::LightmapPage page = makePage(7, 7);
  setTexel(page, 3, 3, 5, 2, {0, 1, 0});
  bake::dilate(page, 2);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x) {
      const bool isNear = std::max(std::abs(x - 3), std::abs(y - 3)) <= 2;
      EXPECT_EQ(*page.owner.at(x, y), isNear ? 5u : kNoInstance) << x << " " << y;
      EXPECT_EQ(page.irradiance.at(x, y)[2], isNear ? 2.f : 0.f) << x << " " << y;
      EXPECT_EQ(page.sh.at(x, y)[3], isNear ? 4.f : 0.f) << x << " " << y;
    }
}

TEST(Dilation, TakesTheMeanAndKeepsNormalsUnit) {
  bake::LightmapPage page = makePage(3, 1);
  setTexel(page, 0, 0, 1, 1, {1, 0, 0});
  setTexel(page, 2, 0, 1, 3, {0, 1, 0});
  bake::dilate(page, 1);
  EXPECT_EQ(page.irradiance.at(1, 0)[0], 2.f);
  EXPECT_NEAR(page.normal.at(1, 0)[0], std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(page.normal.at(1, 0)[1], std::sqrt(0.5f), 1e-6f);
}

TEST(Dilation, GivesOppositeNormalsOneOfThem) {
  bake::LightmapPage page = makePage(3, 1);
  setTexel(page, 0, 0, 1, 1, {0, 0, 1});
  setTexel(page, 2, 0, 1, 1, {0, 0, -1});
  bake::dilate(page, 1);
  EXPECT_EQ(page.normal.at(1, 0)[2], 1.f);
}

TEST(Dilation, MixesNoLightOfTwoObjects) {
  bake::LightmapPage page = makePage(3, 1);
  setTexel(page, 0, 0, 9, 1, {0, 0, 1});
  setTexel(page, 2, 0, 4, 3, {0, 0, 1});
  bake::dilate(page, 5);
  EXPECT_EQ(*page.owner.at(1, 0), 4u);
  EXPECT_EQ(page.irradiance.at(1, 0)[0], 3.f);
}

TEST(Dilation, RefillsInvalidTexelsFromTheirOwnObjectHoweverFar) {
  bake::LightmapPage page = makePage(8, 1);
  base::Image8 invalid(8, 1, 1);
  setTexel(page, 0, 0, 1, 6, {0, 0, 1});
  for (int x = 1; x < 6; ++x) {
    setTexel(page, x, 0, 1, -100, {0, 0, 1});
    *invalid.at(x, 0) = 1;
  }
  setTexel(page, 6, 0, 0, 50, {0, 0, 1}); // of another object
  bake::dilate(page, 1, invalid);
  for (int x = 0; x < 6; ++x) EXPECT_EQ(page.irradiance.at(x, 0)[0], 6.f) << x;
  EXPECT_EQ(page.irradiance.at(6, 0)[0], 50.f);
  EXPECT_EQ(page.irradiance.at(7, 0)[0], 50.f);
}

TEST(Dilation, LeavesAnObjectThatIsInvalidThroughout) {
  bake::LightmapPage page = makePage(2, 1);
  setTexel(page, 0, 0, 1, 6, {0, 0, 1});
  base::Image8 invalid(2, 1, 1, 1);
  bake::dilate(page, 1, invalid);
  EXPECT_EQ(page.irradiance.at(0, 0)[0], 6.f);
  EXPECT_EQ(*page.owner.at(1, 0), 1u);
}

TEST(Dilation, RoundsBytes) {
  base::BasicImage<std::uint32_t> owner(3, 1, 1, kNoInstance);
  base::Image8 values(3, 1, 1);
  *owner.at(0, 0) = *owner.at(2, 0) = 0;
  *values.at(0, 0) = 10;
  *values.at(2, 0) = 255;
  bake::dilate(values, owner, 1);
  EXPECT_EQ(*values.at(1, 0), 133); // of 132.5
  EXPECT_EQ(*owner.at(1, 0), 0u);
}

} // namespace
} // namespace parity::tests
