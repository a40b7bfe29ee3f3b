// Groups are of neighbours of one object, and have every texel once.
#include "bake/light/texel_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bake/bake_scenes.h"

namespace parity::bake {
namespace {

using namespace tests;

TEST(TexelGroups, HaveEachTexelOnceWithNeighboursOfItsObject) {
  scenes::Scene scene;
  addObject(scene, insideOfBox(0.5), matte("box", 0.5f));
  addObject(scene, scenes::makeSphere(0.2, 16, 8), matte("ball", 0.5f));
  const Atlas atlas = makeAtlas(scene, {.texelsPerMetre = 16});
  const TexelGrid grid(scene, atlas, 4);
  const TexelGroups groups(grid);
  std::vector<int> times(grid.texels().size());
  for (std::size_t g = 0; g < groups.count(); ++g) {
    ASSERT_GE(groups[g].size(), 1u);
    ASSERT_LE(groups[g].size(), TexelGroups::kMost);
    const Texel& first = grid.texels()[groups[g][0]];
    for (const std::uint32_t i : groups[g]) {
      ++times[i];
      const Texel& t = grid.texels()[i];
      EXPECT_EQ(t.page, first.page);
      EXPECT_EQ(t.instance, first.instance);
      EXPECT_LT(std::abs(t.x - first.x), TexelGroups::kSide);
      EXPECT_LT(std::abs(t.y - first.y), TexelGroups::kSide);
    }
  }
  EXPECT_TRUE(std::ranges::all_of(times, [](int n) { return n == 1; }));
  EXPECT_LT(groups.count(), grid.texels().size() / 4);
}

} // namespace
} // namespace parity::bake
