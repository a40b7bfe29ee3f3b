// A path that the program does not know stands in every command once it is added.
#include <cstdlib>
#include <set>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class ThirdPath : public RenderingTest {
protected:
  ThirdPath() { setenv("PARITY_EXECUTABLE", PARITY_WITH_LAMBERT, 1); }
  ~ThirdPath() override { unsetenv("PARITY_EXECUTABLE"); }
  static inline const std::vector<std::string> kThree = {"--paths", "highend,mobile,lambert"};
};

const json& view(const json& report, std::size_t i) { return report.at("scenes").at(0).at("views").at(i); }

TEST_F(ThirdPath, HasARowOfItsOwnInReportAndPage) {
  const std::filesystem::path folder = m_folder / "report";
  const RunResult result = runParity(join(
      {{"report", "builtin:spheres", "--env", "builtin:studio", "--truth", "--error", "10%", "-o", folder.string()},
       kThree,
       kSmall,
       kRoughSky,
       kSun}));
  EXPECT_EQ(result.signal, 0) << result.err;
  const json report = json::parse(readWholeFile(folder / "report.json"));
  ASSERT_EQ(report.at("scenes").at(0).at("views").size(), 2u);
  EXPECT_EQ(view(report, 0).at("test"), "mobile");
  EXPECT_EQ(view(report, 1).at("reference"), "highend");
  EXPECT_EQ(view(report, 1).at("test"), "lambert");
  EXPECT_GT(view(report, 1).at("whole").at("figures").at("metrics").at("flip.mean"),
            view(report, 0).at("whole").at("figures").at("metrics").at("flip.mean"))
      << "without reflections it is farther off";
  EXPECT_GT(view(report, 1).at("whole").at("truth").at("figures").at("test").at("metrics").at("flip.mean"), 0.01);
  bool hasAttribution = false;
  for (const json& material : view(report, 1).at("materials")) {
    EXPECT_FALSE(contains(material.at("bias").get<std::string>(), "mobile")) << material.at("bias");
    EXPECT_FALSE(contains(material.at("truth").at("notes").dump(), "mobile")) << material.at("truth");
    hasAttribution |= material.contains("attribution");
  }
  EXPECT_TRUE(hasAttribution);
  EXPECT_TRUE(contains(result.out, "has the colours of mobile or lambert, all others those of high-end."))
      << result.out;
  EXPECT_TRUE(contains(result.out, "hi/truth, mo/truth, la/truth: mean FLIP of high-end and of mobile and of lambert"));
  std::set<std::string> names;
  for (std::size_t i : {0, 1})
    for (const auto& [kind, file] : view(report, i).at("images").items()) {
      EXPECT_TRUE(names.insert(file.get<std::string>()).second) << file;
      EXPECT_TRUE(std::filesystem::exists(folder / file.get<std::string>())) << file;
    }
  EXPECT_TRUE(contains(readWholeFile(folder / "index.html"), "lambert"));
  EXPECT_TRUE(contains(readWholeFile(folder / "scenes" / "0.js"), "\"test\":\"lambert\""));
  std::set<std::string> passes;
  for (const json& pass : report.at("scenes").at(0).at("passes")) passes.insert(pass.at("name"));
  EXPECT_TRUE(passes.contains("shade lambert"));
}

// A cached report is the same, and the rows of two paths are as without the third.
TEST_F(ThirdPath, ChangesNoOtherRow) {
  const std::string file = (m_folder / "diff.json").string(), cache = (m_folder / "cache").string();
  const auto diff = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(
        runParity(join({{"diff", "builtin:spheres", "--json", file, "--cache", cache, "--size", "64x64"}, kSun, more}))
            .signal,
        0);
    return json::parse(readWholeFile(file));
  };
  const json two = diff({}), three = diff(kThree), again = diff(kThree);
  EXPECT_EQ(three.at("scenes"), again.at("scenes"));
  EXPECT_EQ(view(two, 0).at("whole"), view(three, 0).at("whole"));
  EXPECT_EQ(view(two, 0).at("materials"), view(three, 0).at("materials"));
}

TEST_F(ThirdPath, IsRenderedWithItsKnob) {
  const auto render = [&](const char* scale) {
    const std::string file = (m_folder / "a.exr").string();
    EXPECT_TRUE(exitedWith(0, runParity(join({{"render", "builtin:spheres", "--path", "lambert", "--albedo-scale",
                                               scale, "--term", "sunDiffuse", "-o", file},
                                              kSmall,
                                              kSun}))));
    return base::readImage(file);
  };
  const base::Image plain = render("1"), half = render("0.5");
  double sum = 0;
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    EXPECT_NEAR(half.pixels[i], 0.5f * plain.pixels[i], 1e-5f);
    sum += plain.pixels[i];
  }
  EXPECT_GT(sum, 10);
  EXPECT_TRUE(contains(runParity({"report", "--help"}).out, "--albedo-scale"));
  EXPECT_TRUE(contains(runParity({"knobs"}).out, "albedo-scale"));
}

// It binds no maps of the environment: its light comes from coefficients. No term is taken for 0 by what is bound.
TEST_F(ThirdPath, HasTheTermsThatItsShaderWrites) {
  const auto meanOf = [&](const std::vector<std::string>& term) {
    const std::string file = (m_folder / "a.exr").string();
    EXPECT_TRUE(exitedWith(
        0, runParity(join({{"render", "builtin:spheres", "--path", "lambert", "--env", "builtin:studio", "-o", file},
                           term,
                           kSmall,
                           kRoughSky,
                           kSun}))));
    const base::Image image = base::readImage(file);
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) sum += image.pixels[i];
    return sum / static_cast<double>(image.pixels.size());
  };
  EXPECT_GT(meanOf({"--term", "skyDiffuse"}), 0.01);
  EXPECT_EQ(meanOf({"--term", "skySpecular"}), 0);
}

TEST_F(ThirdPath, StandsInBenchAndStress) {
  const RunResult list = runParity(join({{"bench", "--list"}, kThree}));
  EXPECT_TRUE(contains(list.out, "lambert: default")) << list.out;
  const std::string file = (m_folder / "bench.json").string();
  const RunResult bench = runParity(join({{"bench", "builtin:spheres", "--settings", "lambert*", "--rounds", "2",
                                           "--no-truth", "--size", "32x32", "--no-cache", "--json", file},
                                          kThree,
                                          kSun}));
  EXPECT_TRUE(exitedWith(0, bench));
  bool isThere = false;
  const json swept = json::parse(readWholeFile(file));
  for (const json& variant : swept.at("scenes").at(0).at("variants")) isThere |= variant.at("path") == "lambert";
  EXPECT_TRUE(isThere);
  const std::string stress = (m_folder / "stress.json").string();
  runParity({"stress", "--only", "renders", "--renders", "roughness*", "--scenes", "0", "--json", stress});
  EXPECT_TRUE(contains(readWholeFile(stress), "\"lambert\""));
}

TEST_F(ThirdPath, WithoutAnEnvironmentBrdfIsNotPlotted) {
  const std::vector<std::string> plot = {"plot", "env-brdf", "-o", (m_folder / "plot").string(), "--paths"};
  expectRefused(runParity(join({plot, {"highend,lambert"}})), 64, {"--paths: lambert: has no environment BRDF"});
  expectRefused(runParity(join({plot, {"highend,mobile,lambert"}})), 64, {"two paths"});
}

} // namespace
} // namespace parity::tests
