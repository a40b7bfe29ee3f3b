// Maps in layers: none overlaps another, nothing is wasted but the end, limits are told.
#include "gpu/shadows/shadow_tiles.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

#include "base/error.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t kMaxSide = 16384, kMaxLayers = 2048;

// Every map's cells of 16 texels.
void expectDisjoint(const std::vector<std::uint32_t>& sides, const ShadowTiling& tiling) {
  std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> taken;
  std::size_t cells = 0;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const ShadowTile& tile = tiling.tiles[k];
    EXPECT_LT(tile.layer, tiling.layers);
    EXPECT_LE(tile.x + sides[k], tiling.side);
    EXPECT_LE(tile.y + sides[k], tiling.side);
    for (std::uint32_t y = 0; y < sides[k]; y += 16)
      for (std::uint32_t x = 0; x < sides[k]; x += 16) {
        taken.emplace(tile.layer, (tile.x + x) / 16, (tile.y + y) / 16);
        ++cells;
      }
  }
  EXPECT_EQ(taken.size(), cells);
  // All layers but the last are full.
  const std::size_t ofLayer = std::size_t{tiling.side} / 16 * (tiling.side / 16);
  EXPECT_GT(cells, (tiling.layers - 1) * ofLayer);
}

TEST(ShadowTiles, OfAllSizesLieApart) {
  std::mt19937 random(7);
  for (const std::size_t count : {1, 5, 60, 400}) {
    std::vector<std::uint32_t> sides;
    for (std::size_t k = 0; k < count; ++k) sides.push_back(16u << random() % 8);
    SCOPED_TRACE(count);
    expectDisjoint(sides, packTiles(sides, kMaxSide, kMaxLayers, "device"));
  }
}

TEST(ShadowTiles, FewSmallMapsTakeASmallImage) {
  const std::vector<std::uint32_t> sides = {0, 256, 256, 0, 256};
  const ShadowTiling tiling = packTiles(sides, kMaxSide, kMaxLayers, "device");
  EXPECT_EQ(tiling.side, 512u);
  EXPECT_EQ(tiling.layers, 1u);
  const ShadowTiling none = packTiles(std::vector<std::uint32_t>{0, 0}, kMaxSide, kMaxLayers, "device");
  EXPECT_EQ(none.side, 1u);
  EXPECT_EQ(none.layers, 1u);
}

TEST(ShadowTiles, LayersAreNoLargerThanTheDeviceTakes) {
  const std::vector<std::uint32_t> sides(12, 512);
  const ShadowTiling tiling = packTiles(sides, 1024, kMaxLayers, "device");
  EXPECT_EQ(tiling.side, 1024u);
  EXPECT_EQ(tiling.layers, 3u);
  expectDisjoint(sides, tiling);
}

std::string refusal(const std::vector<std::uint32_t>& sides, std::uint32_t maxSide, std::uint32_t maxLayers) {
  try {
    packTiles(sides, maxSide, maxLayers, "small device");
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::failed);
    return error.what();
  }
  return "";
}

TEST(ShadowTiles, LimitsAreTold) {
  EXPECT_EQ(refusal({512}, 256, 4), "small device: shadow map of 512x512: the device allows at most 256 texels a side");
  EXPECT_EQ(refusal(std::vector<std::uint32_t>(17, 512), 1024, 4),
            "small device: shadow maps in 5 layers of 1024x1024: the device allows at most 4 layers");
  EXPECT_EQ(refusal(std::vector<std::uint32_t>(16, 512), 1024, 4), "");
}

} // namespace
} // namespace parity::gpu
