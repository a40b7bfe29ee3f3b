// The seven real assets in the three real environments, through a whole report, with and without a sun.
#include "cli/checks.h"
#include "support/shared_assets.h"

namespace parity::tests {
namespace {

const char* const kAssets[] = {"WaterBottle/WaterBottle.gltf",
                               "BoomBoxWithAxes/BoomBoxWithAxes.gltf",
                               "Suzanne/Suzanne.gltf",
                               "ToyCar/ToyCar.gltf",
                               "MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb",
                               "NormalTangentTest/NormalTangentTest.glb",
                               "LightsPunctualLamp/LightsPunctualLamp.gltf"};

class AssetsTest : public RenderingTest, public testing::WithParamInterface<std::tuple<std::string, bool>> {};

TEST_P(AssetsTest, GiveAWholeReport) {
  const auto& [environment, withSun] = GetParam();
  const std::filesystem::path assets = sharedAssets();
  if (assets.empty()) GTEST_SKIP() << "PARITY_SHARED is not there: no assets";
  const std::filesystem::path folder = m_folder / "out";
  std::vector<std::string> command = {"report", "--env",        (assets / "env" / environment).string(),
                                      "--size", "128x128",      "--validation",
                                      "-o",     folder.string()};
  if (withSun) command = join({command, kSun});
  for (const char* asset : kAssets) command.push_back((assets / asset).string());
  RunOptions options;
  options.timeoutS = 400;
  const RunResult result = runParity(command, options);
  ASSERT_GE(result.exitCode, 0) << "signal " << result.signal << "\n" << result.err;
  EXPECT_LE(result.exitCode, 2) << result.err;
  EXPECT_FALSE(contains(result.err, "error: ")) << result.err;

  const nlohmann::json report = readReport(folder);
  ASSERT_EQ(report["scenes"].size(), std::size(kAssets));
  for (const nlohmann::json& scene : report["scenes"]) {
    EXPECT_TRUE(scene["error"].is_null()) << scene["error"];
    EXPECT_EQ(scene["environment"], environment);
    const nlohmann::json& whole = scene["views"][0]["whole"]["figures"];
    EXPECT_GT(whole["pixels"].get<int>(), 128 * 128 / 20) << scene["name"] << " is hardly in the picture";
    EXPECT_EQ(whole["nonFinite"], 0) << scene["name"];
    for (const char* luma : {"referenceLuma", "testLuma"}) {
      EXPECT_GT(whole[luma].get<double>(), 0.02) << scene["name"] << " is black";
      EXPECT_LT(whole[luma].get<double>(), 0.98) << scene["name"] << " is white";
    }
  }
  for (const std::string& picture : listPictures(report)) EXPECT_TRUE(std::filesystem::exists(folder / picture));
}

INSTANTIATE_TEST_SUITE_P(, AssetsTest,
                         testing::Combine(testing::Values<std::string>("studio_small_05_1k.hdr",
                                                                       "chinese_garden_1k.hdr",
                                                                       "st_peters_square_night_1k.hdr"),
                                          testing::Bool()),
                         [](const auto& test) {
                           const std::string environment = std::get<0>(test.param);
                           return environment.substr(0, environment.find('_')) +
                                  (std::get<1>(test.param) ? "WithSun" : "");
                         });

} // namespace
} // namespace parity::tests
