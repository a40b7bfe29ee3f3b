// Real assets in an atlas.
#include <filesystem>
#include <iostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bake/atlas/atlas.h"
#include "bake/atlas_truth.h"
#include "scenes/load.h"
#include "support/shared_assets.h"

namespace parity::tests {
namespace {

TEST(Atlas, IsSoundForRealAssets) {
  const std::filesystem::path assets = tests::sharedAssets();
  if (assets.empty()) GTEST_SKIP() << "no shared assets";
  const std::vector<std::pair<std::string, double>> cases = {
      {"Suzanne/Suzanne.gltf", 100}, {"ToyCar/ToyCar.gltf", 5000}, {"BoomBoxWithAxes/BoomBoxWithAxes.gltf", 200}};
  for (const auto& [file, density] : cases) {
    const scenes::Scene scene = scenes::loadScene((assets / file).string());
    const bake::AtlasOptions options{density, 2048, 2};
    const bake::Atlas atlas = bake::makeAtlas(scene, options);
    const AtlasFacts facts = measureAtlas(scene, atlas);
    expectSound(facts, options, file);
    std::cout << fmt::format("{}: {} x {}^2 texels, {} charts, {:.1f} % covered\n", file, atlas.pageCount,
                             atlas.pageSide, facts.charts, 100 * facts.coverage);
  }
}

} // namespace
} // namespace parity::tests
