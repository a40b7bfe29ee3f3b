// parity flip agrees with the published metric, and with what a report says of the pictures it writes.
#include <algorithm>
#include <cmath>

#include "base/image/image_io.h"
#include "cli/flip/flip_pictures.h"

namespace parity::tests {
namespace {

const std::string kGolden = std::string(PARITY_SOURCE_DIR) + "/tests/compare/flip/golden/";

// Figures of docs/flip-metric.md 8 for this pair, made with NVIDIA's tool.
TEST(FlipCommand, GoldenPairHasThePublishedFigures) {
  const TempFolder folder;
  const std::string map = (folder / "map.pfm").string();
  const std::vector<std::string> pair = {kGolden + "ldrsyn256.ref.png", kGolden + "ldrsyn256.test.png"};
  const nlohmann::json json = flipJson(join({pair, {"-o", map}}));
  const nlohmann::json pooling = json["pairs"][0]["pooling"];
  EXPECT_NEAR(firstFigures(json)["flip.mean"].get<double>(), .155656994, 1e-6);
  EXPECT_NEAR(pooling["mean"].get<double>(), .155656994, 1e-6);
  EXPECT_NEAR(pooling["weightedMedian"].get<double>(), .220928873, 1e-5);
  EXPECT_NEAR(pooling["weightedQ1"].get<double>(), .173131, 1e-5);
  EXPECT_NEAR(pooling["weightedQ3"].get<double>(), .295348, 1e-5);
  EXPECT_NEAR(pooling["max"].get<double>(), .998370, 1e-5);
  EXPECT_NEAR(firstFigures(flipJson(join({pair, {"--ppd", "20"}})))["flip.mean"].get<double>(), .143722894, 1e-6);

  const base::Image ours = base::readImage(map), golden = base::readImage(kGolden + "ldrsyn256.flip.pfm");
  ASSERT_EQ(ours.pixelCount(), golden.pixelCount());
  for (std::size_t i = 0; i < ours.pixels.size(); ++i) ASSERT_NEAR(ours.pixels[i], golden.pixels[i], 1e-4) << i;

  const RunResult printed = runParity(join({{"flip"}, pair}));
  EXPECT_TRUE(contains(printed.out, "0.155657")) << printed.out;
}

TEST(FlipCommand, MapIsTheSameInEveryKindOfFile) {
  const TempFolder folder;
  const std::vector<std::string> pair = {kGolden + "ldrext64.ref.png", kGolden + "ldrext64.test.png"};
  for (const char* name : {"map.exr", "map.pfm", "map.png"}) flipJson(join({pair, {"-o", (folder / name).string()}}));
  EXPECT_EQ(base::readImage(folder / "map.exr"), base::readImage(folder / "map.pfm"));
  EXPECT_EQ(base::readImage8(folder / "map.png", 3).channels, 3);
}

TEST(FlipCommand, IdenticalImagesDifferByNothing) {
  const std::string image = kGolden + "ldrext64.ref.png";
  const nlohmann::json json = flipJson({image, image});
  EXPECT_EQ(firstFigures(json)["flip.max"], 0);
  EXPECT_EQ(firstFigures(json)["rmse"], 0);
  EXPECT_TRUE(firstFigures(json)["psnr"].is_null()) << "infinite";
  EXPECT_EQ(json["pairs"][0]["identical"], true);
}

// Float files are linear light: the EXR of a PNG's linear values is the same picture.
TEST(FlipCommand, FloatFilesAreTakenAsLinear) {
  const TempFolder folder;
  base::Image image = base::readImage(kGolden + "ldrext64.ref.png");
  for (float& v : image.pixels) v = v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  base::writeImage(folder / "linear.exr", image);
  const nlohmann::json json = flipJson({kGolden + "ldrext64.ref.png", (folder / "linear.exr").string()});
  EXPECT_LT(firstFigures(json)["flip.max"].get<double>(), 1e-3);
}

class FlipOfAReport : public RenderingTest {};

// A quad that fills the picture: the whole image is the material, so the report's figures are those of the pictures.
TEST_F(FlipOfAReport, IsTheFlipOfTheWrittenPictures) {
  GltfFile file = makeQuad();
  file.material()["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"roughnessFactor", 0.6}};
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(join({{"report", writeExternal(m_folder, file), "--env", "builtin:studio",
                                            "--orbit", "0,90,0.4", "-o", folder.string()},
                                           kSun,
                                           kSmall}));
  ASSERT_NE(result.exitCode, 4) << result.err;
  const nlohmann::json report = readReport(folder), view = report["scenes"][0]["views"][0];
  const nlohmann::json& figures = view["whole"]["figures"];
  ASSERT_EQ(figures["pixels"], 64 * 64);
  ASSERT_GT(figures["metrics"]["flip.mean"].get<double>(), 0.01) << "nothing differs: nothing is tested";

  const auto picture = [&](const char* key) { return (folder / view["images"][key].get<std::string>()).string(); };
  const std::string map = path("map.png");
  const nlohmann::json again = flipJson({picture("reference"), picture("test"), "-o", map});
  EXPECT_NEAR(firstFigures(again)["flip.mean"].get<double>(), figures["metrics"]["flip.mean"].get<double>(), 1e-6);
  EXPECT_NEAR(firstFigures(again)["flip.max"].get<double>(), figures["metrics"]["flip.max"].get<double>(), 1e-6);
  EXPECT_NEAR(firstFigures(again)["rmse"].get<double>(), figures["metrics"]["rmse"].get<double>(), 1e-6);
  EXPECT_NEAR(firstFigures(again)["psnr"].get<double>(), figures["metrics"]["psnr"].get<double>(), 1e-4);
  // An error that differs in its last digit may fall on the other side of a rounding of the colour map.
  const base::Image8 mapped = base::readImage8(map, 3), shown = base::readImage8(picture("flip"), 3);
  ASSERT_EQ(mapped.pixels.size(), shown.pixels.size());
  for (std::size_t i = 0; i < shown.pixels.size(); ++i) ASSERT_NEAR(mapped.pixels[i], shown.pixels[i], 1);
}

TEST_F(FlipOfAReport, MapIsTheSameWithABackgroundToo) {
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(
      join({{"report", "builtin:lamps", "--background", "0.9,0.1,0.4", "-o", folder.string()}, kSun, kSmall}));
  ASSERT_NE(result.exitCode, 4) << result.err;
  const nlohmann::json view = readReport(folder)["scenes"][0]["views"][0];
  const auto picture = [&](const char* key) { return (folder / view["images"][key].get<std::string>()).string(); };
  const std::string map = path("map.png");
  flipJson({picture("reference"), picture("test"), "-o", map});
  EXPECT_EQ(base::readImage8(map, 3), base::readImage8(picture("flip"), 3));
}

// Beside a metal that differs stands a sign that does not: FLIP of the whole picture reaches over it from the rim, its
// own does not.
TEST_F(FlipOfAReport, MapOfAMaterialShowsNothingOfItsNeighbour) {
  GltfFile file = makeQuad();
  file.material()["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"roughnessFactor", 0.6}};
  file.json["extensionsUsed"] = {"KHR_materials_unlit"};
  file.json["materials"].push_back(
      {{"name", "sign"}, {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}});
  file.json["meshes"].push_back(file.json["meshes"][0]);
  file.json["meshes"][1]["primitives"][0]["material"] = 1;
  file.json["nodes"].push_back({{"mesh", 1}, {"translation", {1, 0, 0}}});
  file.json["scenes"][0]["nodes"].push_back(1);
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(
      join({{"report", writeExternal(m_folder, file), "--orbit", "0,90,2", "-o", folder.string()}, kSun, kSmall}));
  ASSERT_NE(result.exitCode, 4) << result.err;
  const nlohmann::json view = readReport(folder)["scenes"][0]["views"][0];
  const auto mapOf = [&](const nlohmann::json& images) {
    return base::readImage8(folder / images["flip"].get<std::string>(), 3);
  };
  const base::Image8 whole = mapOf(view["images"]), metal = mapOf(view["materials"][0]["crops"]),
                     sign = mapOf(view["materials"][1]["crops"]);
  base::Image8 none(sign.width, sign.height, 3); // magma at 0, as in the corner of the background
  for (std::size_t i = 0; i < none.pixels.size(); ++i) none.pixels[i] = whole.pixels[i % 3];
  EXPECT_EQ(sign, none);
  EXPECT_GT(*std::ranges::max_element(metal.pixels), *std::ranges::max_element(none.pixels)) << "nothing differs";
  EXPECT_EQ(view["materials"][1]["figures"]["metrics"]["flip.max"], 0);
}

} // namespace
} // namespace parity::tests
