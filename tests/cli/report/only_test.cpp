// --only and --material over several scenes: what matches is compared, what does not is left out, a mistake is an
// error.
#include "cli/checks.h"

namespace parity::tests {
namespace {

class OnlyTest : public RenderingTest {
protected:
  void SetUp() override {
    RenderingTest::SetUp();
    m_suite = write("s.toml", R"(
[defaults]
environment = "builtin:studio"
[[scene]]
file = "builtin:materials"
[[scene.view]]
name = "front"
[[scene.view]]
name = "left side"
orbit = [60, 70, 0]
[[scene]]
name = "balls"
file = "builtin:spheres"
)");
  }
  RunResult report(const std::string& folder, const std::vector<std::string>& more) const {
    return runParity(join({{"report", "--suite", m_suite, "-o", path(folder)}, kSmall, more}));
  }
  static std::vector<std::string> viewsOf(const nlohmann::json& report) {
    std::vector<std::string> views;
    for (const nlohmann::json& scene : report["scenes"])
      for (const nlohmann::json& view : scene["views"])
        views.push_back(scene["name"].get<std::string>() + "/" + view["name"].get<std::string>());
    return views;
  }
  std::string m_suite;
};

TEST_F(OnlyTest, ComparesTheViewsThatAreMeant) {
  const RunResult one = report("one", {"--only", "materials/left*"});
  ASSERT_TRUE(isReported(one));
  EXPECT_EQ(viewsOf(readReport(m_folder / "one")), std::vector<std::string>{"materials/left side"});
  EXPECT_TRUE(contains(one.err, "--only: 1 of 2 scenes, 1 of 3 views")) << one.err;
  ASSERT_TRUE(isReported(report("scene", {"--only", "materials"})));
  EXPECT_EQ(viewsOf(readReport(m_folder / "scene")),
            (std::vector<std::string>{"materials/front", "materials/left side"}));
  ASSERT_TRUE(isReported(report("two", {"--only", "balls", "--only", "*/front"})));
  EXPECT_EQ(viewsOf(readReport(m_folder / "two")), (std::vector<std::string>{"materials/front", "balls/auto"}));
}

TEST_F(OnlyTest, AGlobThatMeansNothingIsRefusedWithTheNearestName) {
  expectRefused(
      report("out", {"--only", "materials/left sid"}), 64,
      {"--only", "'materials/left sid'", "no scene or view has this name", "did you mean 'materials/left side'?"});
  expectRefused(report("out", {"--only", "balls", "--only", "material"}), 64, {"did you mean 'materials'?"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out")) << "before anything is written";
}

TEST_F(OnlyTest, GivesTheFiguresOfTheWholeRunAndNothingIsGone) {
  ASSERT_TRUE(isReported(report("whole", {})));
  const RunResult part = report("part", {"--only", "materials/left side", "--baseline", path("whole")});
  ASSERT_TRUE(isReported(part));
  const nlohmann::json now = readReport(m_folder / "part");
  EXPECT_TRUE(now["baseline"]["gone"].empty()) << now["baseline"];
  EXPECT_TRUE(now["warnings"].empty()) << now["warnings"];
  const nlohmann::json whole = readReport(m_folder / "whole");
  const nlohmann::json &then = whole["scenes"][0]["views"][1]["materials"],
                       &again = now["scenes"][0]["views"][0]["materials"];
  ASSERT_EQ(then.size(), again.size());
  for (std::size_t i = 0; i < then.size(); ++i) EXPECT_EQ(then[i]["figures"], again[i]["figures"]) << then[i]["name"];
}

TEST_F(OnlyTest, ARequiredMaterialThatAnotherViewShowsDoesNotFail) {
  const std::string budgets = write("b.toml", R"(
[[material]]
name = "*"
require_seen = true
min_pixels = 4000
checks = [ { metric = "flip.mean", fail = 0.999 } ]
[[whole]]
checks = [ { metric = "flip.mean", fail = 0.999 } ])");
  const nlohmann::json whole = (report("whole", {"--budgets", budgets}), readReport(m_folder / "whole"));
  EXPECT_EQ(whole["verdict"], "fail") << "no material is that large";
  report("part", {"--budgets", budgets, "--only", "materials/front"});
  for (const nlohmann::json& material : readReport(m_folder / "part")["scenes"][0]["views"][0]["materials"])
    EXPECT_NE(material["verdict"], "fail") << material;
}

TEST_F(OnlyTest, AMaterialThatASceneLacksSkipsTheSceneWithALine) {
  const RunResult result = report("gold", {"--material", "glazed ceramic", "--baseline", path("whole")});
  EXPECT_EQ(result.exitCode, 4) << "there is no baseline yet";
  ASSERT_TRUE(isReported(report("whole", {})));
  const RunResult gold = report("gold", {"--material", "glazed ceramic", "--baseline", path("whole")});
  ASSERT_TRUE(isReported(gold));
  EXPECT_TRUE(contains(gold.err, "--material: 1 of 2 scenes is skipped, because they have no such material: balls"))
      << gold.err;
  const nlohmann::json now = readReport(m_folder / "gold");
  EXPECT_EQ(viewsOf(now), (std::vector<std::string>{"materials/front", "materials/left side"}));
  EXPECT_TRUE(now["baseline"]["gone"].empty()) << now["baseline"];
}

TEST_F(OnlyTest, AMaterialThatNoSceneHasIsAnErrorWithTheNearestName) {
  const RunResult none = report("none", {"--material", "glazed ceramik"});
  EXPECT_TRUE(exitedWith(4, none));
  EXPECT_TRUE(contains(
      none.err, "--material 'glazed ceramik': no scene has a material of this name; did you mean 'glazed ceramic'?"))
      << none.err;
  EXPECT_EQ(readReport(m_folder / "none")["verdict"], "error");
  const RunResult oneOfTwo = report("two", {"--material", "glazed ceramic", "--material", "glazed ceramik"});
  EXPECT_TRUE(exitedWith(4, oneOfTwo)) << "the other one is a mistake all the same";
  EXPECT_EQ(viewsOf(readReport(m_folder / "two")).size(), 2u);
}

// The whole run keeps results of scenes that have a material of some glob; one scene alone needs one of each. Without
// the validation layer, under which no result is recalled.
TEST_F(OnlyTest, AMaterialThatASceneLacksIsAnErrorAlsoOfAKeptResult) {
  const auto diff = [&](const std::vector<std::string>& more) {
    return runParity(join({{"diff", "--suite", m_suite, "--cache", path("cache"), "--size", "64x64", "-v", "--material",
                            "gold", "--material", "glazed ceramic"},
                           kRoughSky,
                           more}));
  };
  EXPECT_NE(diff({}).exitCode, 4);
  EXPECT_TRUE(contains(diff({}).err, "balls: taken from the cache"));
  EXPECT_TRUE(exitedWith(4, diff({"--only", "balls"})));
  EXPECT_NE(diff({"--only", "materials"}).exitCode, 4) << "it has both";
}

TEST_F(OnlyTest, BakeAndBenchTakeIt) {
  expectRefused(runParity({"bake", "builtin:room", "--only", "hall", "-o", path("baked")}), 64,
                {"--only", "'hall'", "no scene or view has this name"});
  expectRefused(runParity({"bake", "--suite", m_suite, "--only", "ball"}), 64, {"--only", "did you mean 'balls'?"});
  expectRefused(runParity({"bench", "--suite", m_suite, "--only", "ball", "--list"}), 64,
                {"--only", "did you mean 'balls'?"});
}

} // namespace
} // namespace parity::tests
