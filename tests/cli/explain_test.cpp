// parity explain from end to end: its figures are those of parity diff, and refusals.
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

const std::vector<std::string> kScene = join({{"builtin:materials", "--env", "builtin:sky"}, kSmall});

class ExplainOnDevice : public RenderingTest {
protected:
  json read(const std::string& file) const { return json::parse(readWholeFile(file)); }
  double flipByDiff(const std::vector<std::string>& more, const std::string& material) const {
    const std::string file = path("diff.json");
    runParity(join({{"diff"}, kScene, more, {"--json", file, "-q"}}));
    const json report = read(file);
    for (const json& each : report.at("scenes").at(0).at("views").at(0).at("materials"))
      if (each.at("name") == material) return each.at("figures").at("metrics").at("flip.mean");
    return -1;
  }
};

TEST_F(ExplainOnDevice, FiguresAreThoseOfDiffAndAFailedSceneLosesNothing) {
  const std::string file = path("explain.json");
  const RunResult run = runParity(
      join({{"explain"},
            kScene,
            {"builtin:nothing", "--switch", "sky-sh=9", "--switch", "mobile-nonmetal=on", "--json", file, "-q"}}));
  EXPECT_TRUE(exitedWith(4, run));
  EXPECT_TRUE(contains(run.err, "builtin:nothing")) << run.err;
  const json report = read(file);
  ASSERT_EQ(report.at("scenes").size(), 2u);
  EXPECT_TRUE(report.at("scenes").at(1).contains("error"));
  const json& scene = report.at("scenes").at(0);
  EXPECT_EQ(scene.at("switches").at(0).at("id"), "sky-sh=9");
  EXPECT_EQ(report.at("team").at("materials"), scene.at("materials").size());
  int found = 0;
  for (const json& material : scene.at("materials")) {
    if (material.at("name") != "red plastic") continue;
    ++found;
    const json& sets = material.at("flipOfSets");
    ASSERT_EQ(sets.size(), 4u);
    EXPECT_EQ(sets.at(0).get<double>(), flipByDiff({}, "red plastic"));
    EXPECT_EQ(sets.at(1).get<double>(), flipByDiff({"--sky-sh", "9"}, "red plastic"));
    EXPECT_EQ(sets.at(3).get<double>(), flipByDiff({"--sky-sh", "9", "--mobile-nonmetal"}, "red plastic"));
    EXPECT_GT(material.at("best").at(0).at("cost").at("operations").get<int>(), 100);
  }
  EXPECT_EQ(found, 1);
}

TEST_F(ExplainOnDevice, SaysThatNoSetMeetsTheBudget) {
  const std::string budgets =
      write("budgets.toml", "[[material]]\nname = \"gold\"\nchecks = [ { metric = \"flip.mean\", fail = 0.001 } ]\n");
  const RunResult run = runParity(
      join({{"explain"}, kScene, {"--switch", "formulas=refit", "--material", "gold", "--budgets", budgets, "-q"}}));
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_TRUE(contains(run.out, "no set brings it below 0.001")) << run.out;
}

// Two views of a suite, one of which --only leaves; --all shows also what is within its limit.
TEST_F(ExplainOnDevice, TakesViewsOfASuite) {
  const std::string suite =
      write("suite.toml", "[[scene]]\nname = \"ball\"\nfile = \"builtin:furnace\"\nenv = \"builtin:studio\"\n"
                          "[[scene.view]]\nname = \"a\"\n[[scene.view]]\nname = \"b\"\norbit = [90, 70, 0]\n");
  const RunResult run = runParity({"explain", "--suite", suite, "--only", "ball/b", "--size", "64x64", "--switch",
                                   "sky-sh=9", "--all", "--timings", "--validation"});
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_TRUE(contains(run.out, "ball")) << run.out;
  EXPECT_TRUE(contains(run.out, "best set of each size")) << run.out;
  EXPECT_TRUE(contains(run.err, "shade")) << run.err;
}

TEST(ExplainOptions, LimitsAndBakesAreRefusedAsByReport) {
  const std::vector<std::string> scene = {"explain", "builtin:room", "-q"};
  EXPECT_TRUE(exitedWith(64, runParity(join({scene, {"--max-memory", "1K"}}))));
  EXPECT_TRUE(exitedWith(64, runParity(join({scene, {"--max-image", "x"}}))));
  expectRefused(runParity(join({scene, {"--baked", "no-such-folder"}})), 4, {"no-such-folder"});
}

TEST(ExplainOptions, RefuseWhatCannotBeMeant) {
  std::vector<std::string> many;
  for (int i = 0; i < 8; ++i) many.insert(many.end(), {"--switch", "sky-sh=9"});
  for (const auto& [arguments, parts] : std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>{
           {many, {"--switch", "at most 7"}}, {{"--switch", "sky-sh"}, {"KNOB=VALUE"}}}) {
    const RunResult run = runParity(join({{"explain", "builtin:furnace"}, arguments}));
    EXPECT_TRUE(exitedWith(64, run));
    for (const std::string& part : parts) EXPECT_TRUE(contains(run.err, part)) << run.err;
  }
}

} // namespace
} // namespace parity::tests
