// What a baseline was made of, as a user meets it: a run that differs in anything that decides a figure is not
// comparable, and says in what.
#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class BaselineTest : public RenderingTest {
protected:
  void SetUp() override {
    RenderingTest::SetUp();
    if (IsSkipped()) return;
    writeFile(m_folder / "b.toml", std::string("[[material]]\nname = \"*\"\n"
                                               "regress = [ { metric = \"flip.mean\", fail = 0 } ]\n"
                                               "[[whole]]\nchecks = [ { metric = \"flip.mean\", fail = 0.999 } ]\n"
                                               "regress = [ { metric = \"flip.mean\", fail = 0 } ]\n"));
    for (const float radiance : {0.5f, 0.7f}) base::writeImage(sky(radiance), base::Image(8, 4, 3, radiance));
  }
  std::string sky(float radiance) const { return (m_folder / (radiance < 0.6f ? "a.hdr" : "b.hdr")).string(); }

  // The regressions alone judge the material.
  RunResult report(const std::string& folder, const std::vector<std::string>& more) const {
    return runParity(join({{"report"}, more, {"--budgets", path("b.toml")}, kSmall, kRoughSky, {"-o", path(folder)}}));
  }

  // A quad with two scenes, two variants and an animation.
  std::string writeRich() const {
    GltfFile file = makeQuad();
    file.material()["pbrMetallicRoughness"] = {
        {"metallicFactor", 0}, {"roughnessFactor", 0.5}, {"baseColorFactor", {0.2, 0.2, 0.2, 1}}}; // nothing clips
    file.json["scenes"].push_back(file.json["scenes"][0]);
    file.json["extensionsUsed"] = {"KHR_materials_variants"};
    file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "beach"}}, {{"name", "city"}}};
    file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 0}, {"variants", {0, 1}}}};
    return writeEmbedded(m_folder, std::move(file), "rich");
  }

  // Every row of the report is a warning that says so, and its regressions were not judged.
  void expectNotComparable(const RunResult& result, const std::string& folder, const std::string& sentence) const {
    EXPECT_TRUE(exitedWith(1, result)) << sentence << "\n" << result.out << result.err;
    const json report = readReport(m_folder / folder);
    const json& view = report["scenes"][0]["views"][0];
    std::vector<json> rows = view["materials"].get<std::vector<json>>();
    rows.push_back(view["whole"]);
    for (const json& row : rows) {
      if (row["verdict"] == "not seen") continue;
      EXPECT_EQ(row["verdict"], "warn") << sentence;
      EXPECT_EQ(row["baseline"]["notComparable"], sentence);
      EXPECT_TRUE(row["baseline"]["changes"].empty());
      EXPECT_EQ(row["checks"].back()["verdict"], "not judged") << sentence;
      EXPECT_EQ(row["checks"].back()["note"], "not comparable: " + sentence);
    }
    EXPECT_GE(report["baseline"]["notComparable"], 2) << sentence;
    EXPECT_TRUE(contains(result.out, "not comparable: " + sentence)) << result.out;
    EXPECT_TRUE(contains(result.err, "rows are not comparable: " + sentence)) << result.err;
  }
};

TEST_F(BaselineTest, ARunUnderOtherConditionsIsNotComparableAndSaysWhich) {
  const std::string scene = writeRich();
  const std::vector<std::string> before = {scene, "--env", sky(0.5f), "--sun", "30,50,4"};
  ASSERT_NE(runParity(join({{"report"}, before, kSmall, kRoughSky, {"-o", path("old")}})).exitCode, 4);
  EXPECT_TRUE(exitedWith(0, report("new", join({before, {"--baseline", path("old"), "--warn-exit"}}))));
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--env-rotation", "90"}, "environment rotation was 0, is 90"},
      {{"--target", "0,0,0.25"}, "target was not given, is 0,0,0.25"},
      {{"--fov", "44.5"}, "field of view was 45, is 44.5"},
      {{"--subject", "ball"}, "subject was scene, is ball"},
      {{"--exposure", "1"}, "exposure was 0 EV, is 1 EV"},
      {{"--time", "0.5"}, "time was 0 s, is 0.5 s"},
      {{"--variant", "city"}, "variant was none, is 'city'"},
      {{"--scene", "1"}, "scene of the file was the default, is '1'"},
      {{"--no-sun-extraction"}, "sun extraction was on, is off"},
      {{"--sky-light-color", "0.5,0.5,0.5"}, "sky light color was 1,1,1, is 0.5,0.5,0.5"},
      {{"--sky-sh", "9"}, "mobile sky was 4 SH coefficients, is 9 SH coefficients"},
      {{"--capture", "fp16", "--fresnel", "dielectric"},
       "highend fresnel was schlick, is dielectric; mobile capture was rgbm, is fp16"}};
  for (const auto& [options, sentence] : cases)
    expectNotComparable(report("new", join({before, options, {"--baseline", path("old"), "--warn-exit"}})), "new",
                        sentence);
  // An environment by its content: the same file elsewhere is the same light.
  std::filesystem::copy_file(sky(0.5f), m_folder / "copy.hdr");
  const auto under = [&](const std::string& file) {
    return report("new", {scene, "--env", file, "--sun", "30,50,4", "--baseline", path("old"), "--warn-exit"});
  };
  EXPECT_TRUE(exitedWith(0, under(path("copy.hdr"))));
  const RunResult other = under(sky(0.7f));
  EXPECT_TRUE(exitedWith(1, other));
  EXPECT_TRUE(contains(other.err, "environment was a.hdr (content ")) << other.err;
  EXPECT_FALSE(contains(readWholeFile(m_folder / "new" / "report.json"), m_folder.path().string()));
}

// By a suite: the views have the same names, and one scene says its own exposure.
TEST_F(BaselineTest, OfASuiteSceneByScene) {
  const std::string scene = std::filesystem::path(writeRich()).filename().string();
  const auto run = [&](const std::string& folder, const std::string& first, const std::string& view,
                       const std::vector<std::string>& more) {
    const std::string common = "file = \"" + scene + "\"\nsun = [30, 50, 4]\n";
    writeFile(m_folder / "suite.toml", "[[scene]]\nname = \"one\"\n" + common + first +
                                           "[[scene.view]]\nname = \"front\"\n" + view + "[[scene]]\nname = \"two\"\n" +
                                           common + "[[scene.view]]\nname = \"front\"\n");
    return report(folder, join({{"--suite", path("suite.toml")}, more}));
  };
  const std::vector<std::string> held = {"--baseline", path("old"), "--warn-exit"};
  ASSERT_EQ(run("old", "", "orbit = [0, 80, 2]\n", {}).exitCode, 4) << "regressions alone, and no baseline";
  ASSERT_NE(
      runParity(join({{"report", "--suite", path("suite.toml")}, kSmall, kRoughSky, {"-o", path("old")}})).exitCode, 4);
  EXPECT_TRUE(exitedWith(0, run("new", "", "orbit = [0, 80, 2]\n", held)));
  expectNotComparable(run("new", "", "orbit = [0, 80, 2.5]\n", held), "new", "orbit was 0,80,2, is 0,80,2.5");
  const json two = readReport(m_folder / "new")["scenes"][1]["views"][0];
  EXPECT_EQ(two["verdict"], "pass") << "the other scene is as it was";
  expectNotComparable(run("new", "exposure = 0.5\n", "orbit = [0, 80, 2]\n", held), "new",
                      "exposure was 0 EV, is 0.5 EV");
}

// The truth judges nothing, and what it is made of makes nothing incomparable.
TEST_F(BaselineTest, TruthsOptionsActOnTheTruthAlone) {
  const std::vector<std::string> before = {writeRich(), "--sun", "30,50,4"};
  ASSERT_NE(runParity(join({{"report"}, before, {"--truth"}, kSmall, kRoughSky, {"-o", path("old")}})).exitCode, 4);
  const RunResult result =
      report("new", join({before, {"--truth", "--scattering", "single", "--baseline", path("old"), "--warn-exit"}}));
  EXPECT_TRUE(exitedWith(0, result)) << result.err;
  EXPECT_EQ(readReport(m_folder / "new")["baseline"]["notComparable"], 0);
}

} // namespace
} // namespace parity::tests
