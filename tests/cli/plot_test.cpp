// parity plot: a picture and numbers of a formula, and of a scene's materials.
#include "cli/checks.h"

#include "base/image/image_io.h"

namespace parity::tests {
namespace {

std::vector<std::vector<std::string>> readCsv(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : linesOf(readWholeFile(file))) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class PlotTest : public RenderingTest {};

TEST_F(PlotTest, WritesPictureAndNumbersWithoutADevice) {
  RunOptions options;
  options.environment = {{"VK_DRIVER_FILES", "/nothing"}, {"VK_ICD_FILENAMES", "/nothing"}};
  const std::filesystem::path folder = m_folder / "plot";
  const RunResult result =
      runParity({"plot", "env-brdf", "-o", folder.string(), "--mobile-preset", "karis2014"}, options);
  ASSERT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(contains(result.out, "EnvBRDFApprox (Karis 2014)")) << result.out;
  EXPECT_TRUE(contains(result.out, "env-brdf.png")) << result.out;
  EXPECT_EQ(listFiles(folder), (std::vector<std::string>{"env-brdf.csv", "env-brdf.png"}));
  const base::Image8 picture = base::readImage8(folder / "env-brdf.png", 3);
  EXPECT_GT(picture.width, 1200);
  const auto rows = readCsv(folder / "env-brdf.csv");
  ASSERT_EQ(rows.size(), 65u * 65 + 1);
  EXPECT_EQ(rows[0][2], "table_A");
  // R = N = 1: the article's own 0.45 at F0 = 1 against 1 - ln 2 of Schlick-Smith, .41 of height-correlated.
  EXPECT_NEAR(std::stod(rows.back()[15]), 0.45, 1e-6);
}

TEST_F(PlotTest, SaysHowFarTheApproximationIsOnTheMaterialsOfAScene) {
  const std::filesystem::path folder = m_folder / "plot";
  const RunResult result = runParity({"plot", "env-brdf", "builtin:materials", "-o", folder.string()});
  ASSERT_TRUE(exitedWith(0, result));
  const auto rows = readCsv(folder / "env-brdf-materials.csv");
  ASSERT_GT(rows.size(), 5u);
  EXPECT_EQ(rows[0][0], "material");
  for (std::size_t k = 1; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].size(), rows[0].size());
    EXPECT_TRUE(contains(result.out, rows[k][0].substr(1, rows[k][0].size() - 2))) << "every material is in the table";
    EXPECT_GE(std::stod(rows[k][11]), std::stod(rows[k][9])) << "no mean is above the maximum";
  }
  EXPECT_GT(base::readImage8(folder / "env-brdf.png", 3).height, 1900) << "with a list below";
  EXPECT_EQ(runParity({"plot", "env-brdf", "builtin:materials", "-q", "-o", folder.string()}).out, "");
}

TEST_F(PlotTest, LoadsItsSceneWithinTheLimits) {
  base::writeImage8(path("paint.png"), base::Image8(64, 32, 3, 100));
  GltfFile file = makeQuad();
  file.json["images"] = {{{"uri", "paint.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  const std::vector<std::string> plot = {"plot", "env-brdf", writeExternal(m_folder, file, "painted"),
                                         "-q",   "-o",       path("plot")};
  EXPECT_TRUE(exitedWith(0, runParity(plot)));
  expectRefused(runParity(join({plot, {"--max-image", "32"}})), 4, {"paint.png", "64", "--max-image"});
  expectRefused(runParity(join({plot, {"--max-memory", "1K"}})), 4, {"painted", "--max-memory"});
}

TEST_F(PlotTest, HoldsTheSecondPathAgainstTheFirst) {
  const std::filesystem::path folder = m_folder / "plot";
  const RunResult result = runParity({"plot", "env-brdf", "-o", folder.string(), "--paths", "mobile,highend"});
  ASSERT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(contains(result.out, "Fresnel schlick against the approximation")) << result.out;
  EXPECT_EQ(readCsv(folder / "env-brdf.csv")[0][2], "mobile_A");
}

TEST_F(PlotTest, RefusesASceneThatIsNotThere) {
  expectRefused(runParity({"plot", "env-brdf", "builtin:nothing", "-o", path("plot")}), 4, {"builtin:nothing"});
}

} // namespace
} // namespace parity::tests
