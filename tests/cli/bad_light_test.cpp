// Environments, suites, budgets and scenes without any light: refused in one line, or shown with a warning.
#include <cmath>
#include <limits>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

class BadLightTest : public RenderingTest {
protected:
  // Renders the quad in this environment.
  RunResult renderIn(const std::string& environment) const {
    return runParity(join({{"render", writeExternal(m_folder, makeQuad(), "quad"), "--path", "mobile", "-o",
                            path("out.exr"), "--env", environment},
                           kSmall}));
  }
  void expectEnvironmentRefused(const std::string& environment, const std::vector<std::string>& parts) const {
    expectRefused(renderIn(environment), 4, parts);
    EXPECT_FALSE(std::filesystem::exists(m_folder / "out.exr"));
  }
  std::string writeSuite(const std::string& text) const {
    writeFile(m_folder / "suite.toml", text);
    return path("suite.toml");
  }
  // A suite is checked as a whole before anything is rendered or written.
  void expectSuiteRefused(const std::string& text, const std::vector<std::string>& parts) const {
    const std::filesystem::path folder = m_folder / "out";
    expectRefused(runParity({"report", "--suite", writeSuite(text), "-o", folder.string()}), 4, parts);
    EXPECT_FALSE(std::filesystem::exists(folder));
  }
};

// An environment of one grey with some of its pixels spoilt.
std::string writeSpoiltEnvironment(const TempFolder& folder, const std::vector<std::pair<int, float>>& spoilt) {
  base::Image image(32, 16, 3, 0.5f);
  for (const auto& [value, to] : spoilt) image.pixels[static_cast<std::size_t>(value)] = to;
  base::writeImage(folder / "spoilt.exr", image);
  return (folder / "spoilt.exr").string();
}

TEST_F(BadLightTest, EnvironmentThatCannotBeReadIsRefused) {
  expectEnvironmentRefused(path("none.hdr"), {"none.hdr", "does not exist"});
  expectEnvironmentRefused("builtin:studo", {"builtin:studo", "builtin:studio"});
  writeFile(m_folder / "torn.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16 +X 32\n\x02\x02"));
  expectEnvironmentRefused(path("torn.hdr"), {"torn.hdr"});
  writeFile(m_folder / "text.exr", std::string("not an image"));
  expectEnvironmentRefused(path("text.exr"), {"text.exr"});
}

TEST_F(BadLightTest, EnvironmentOfNoPixelsIsRefused) {
  writeFile(m_folder / "empty.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n"));
  expectEnvironmentRefused(path("empty.hdr"), {"empty.hdr"});
  writeFile(m_folder / "empty.pfm", std::string("PF\n0 0\n-1.0\n"));
  expectEnvironmentRefused(path("empty.pfm"), {"empty.pfm"});
}

// The scene can still be shown: spoilt texels are replaced, counted and said.
TEST_F(BadLightTest, EnvironmentWithNanIsCleanedWithAWarning) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const RunResult result = renderIn(writeSpoiltEnvironment(m_folder, {{30, kNan}, {90, kInf}}));
  ASSERT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(result.err.starts_with("warning: ")) << result.err;
  EXPECT_EQ(linesOf(result.err).size(), 1u) << result.err;
  for (const char* part : {"spoilt", "1 NaN", "1 infinite"}) EXPECT_TRUE(contains(result.err, part)) << result.err;
  const base::Image spoilt = base::readImage(m_folder / "out.exr");
  for (const float value : spoilt.pixels) ASSERT_TRUE(std::isfinite(value));
}

TEST_F(BadLightTest, WarningsOfAScenePassIntoItsReport) {
  const std::string environment = writeSpoiltEnvironment(m_folder, {{30, std::numeric_limits<float>::quiet_NaN()}});
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(join({{"report", writeExternal(m_folder, makeQuad(), "quad"), "--env", environment,
                                            "--budgets", writeBudgets(m_folder, "fail = 0.999"), "-o", folder.string()},
                                           kSmall}));
  ASSERT_TRUE(exitedWith(0, result));
  const nlohmann::json report = readReport(folder);
  ASSERT_EQ(report["scenes"][0]["warnings"].size(), 1u) << report["scenes"][0]["warnings"];
  const std::string warning = report["scenes"][0]["warnings"][0];
  EXPECT_TRUE(contains(warning, "spoilt")) << warning;
  EXPECT_FALSE(contains(warning, m_folder.path().string())) << warning;
}

TEST_F(BadLightTest, SceneWithNeitherLightNorEnvironmentIsRefused) {
  const std::string scene = writeExternal(m_folder, makeQuad());
  expectRefused(runParity(join({{"diff", scene}, kSmall})), 4, {"scene.gltf", "no light and no environment", "--env"});
  expectRefused(runParity(join({{"diff", scene, "--sun", "0,45,0"}, kSmall})), 4, {"no light and no environment"});
}

// What gives light itself can be seen in the dark: a warning, not an error.
TEST_F(BadLightTest, UnlitSceneWithoutLightIsShownWithAWarning) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"KHR_materials_unlit"};
  file.material()["extensions"]["KHR_materials_unlit"] = nlohmann::json::object();
  file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1}; // white is clipped, and not judged
  const RunResult result = runParity(join({{"diff", writeExternal(m_folder, file)}, kSmall}));
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(contains(result.err, "no light and no environment")) << result.err;
}

TEST_F(BadLightTest, SuiteThatCannotBeUsedIsRefused) {
  expectSuiteRefused("[[scene]]\nfile = \"builtin:spheres\"\nenviroment = \"builtin:sky\"\n",
                     {"suite.toml", "line 3", "enviroment", "did you mean 'environment'"});
  expectSuiteRefused("scenes = 3\n", {"suite.toml", "line 1", "scenes"});
  expectSuiteRefused("[[scene]]\nfile = 3\n", {"suite.toml", "line 2", "file", "is not a string"});
  expectSuiteRefused("[[scene]\n", {"suite.toml", "line 1"});
  expectSuiteRefused("name = \"nothing\"\n", {"suite.toml", "no scene"});
  expectRefused(runParity({"report", "--suite", path("none.toml"), "-o", path("out")}), 4,
                {"none.toml", "does not exist"});
}

TEST_F(BadLightTest, BudgetsThatCannotBeUsedAreRefusedBeforeAnythingIsRendered) {
  const std::filesystem::path folder = m_folder / "out";
  writeFile(m_folder / "budgets.toml", std::string("[[material]]\nname = \"*\"\nchecks = [{ metric = \"flip.men\", "
                                                   "fail = 0.1 }]\n"));
  const std::vector<std::string> budgets = {"--budgets", path("budgets.toml")};
  expectRefused(runParity(join({{"diff", "builtin:furnace"}, budgets, kSmall})), 4,
                {"budgets.toml", "line 3", "flip.men", "flip.mean"});
  expectRefused(
      runParity(join({{"report", "builtin:furnace", "builtin:spheres", "-o", folder.string()}, budgets, kSmall})), 4,
      {"budgets.toml", "line 3"});
  EXPECT_FALSE(std::filesystem::exists(folder));
  const auto refused = [&](const std::string& keys, const std::string& check, const std::vector<std::string>& parts) {
    writeFile(m_folder / "budgets.toml", "[[material]]\nname = \"*\"\n" + keys +
                                             "checks = [{ metric = \"flip.mean\", " + check + "fail = 0.1 }]\n");
    expectRefused(runParity(join({{"diff", "builtin:furnace"}, budgets, kSmall})), 4, parts);
  };
  refused("", "region = \"interior\", ", {"budgets.toml", "line 3", "'region' no longer exists", "one figure"});
  refused("min_pixels = -1\n", "", {"budgets.toml", "line 3", "min_pixels", "-1"});
  refused("min_pixels = 1.5\n", "", {"budgets.toml", "line 3", "min_pixels", "whole number"});
  expectRefused(runParity(join({{"diff", "builtin:furnace", "--budgets", path("none.toml")}, kSmall})), 4,
                {"none.toml", "does not exist"});
}

} // namespace
} // namespace parity::tests
