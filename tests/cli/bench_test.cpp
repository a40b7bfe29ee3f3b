// parity bench: short sweeps by the real program.
#include "base/file.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

const std::vector<std::string> kShort = {
    "bench",      "builtin:furnace",      "--size",      "24x24", "--rounds", "5", "--no-truth",
    "--settings", "mobile: capture fp16", "--validation"};

class BenchOnDevice : public RenderingTest {};

TEST(BenchOptions, OlderNameIsTakenWithANote) {
  const RunResult result = runParity({"bench", "--no-reference", "--list"});
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(contains(result.err, "--no-reference is now called --no-truth")) << result.err;
  EXPECT_EQ(runParity({"bench", "--no-reference", "--list", "-q"}).err, "");
}

TEST_F(BenchOnDevice, WritesItsFilesAndAJudgementOfAnEarlierRun) {
  const RunResult first = runParity(join({kShort, {"-o", path("a"), "--budget", "flip.mean=0.9"}}));
  ASSERT_TRUE(exitedWith(0, first));
  std::vector<std::string> files = {"bench.csv", "bench.json", "bench.md", "index.html", "pareto-1.svg"};
  if (!kHasPage) std::erase(files, "index.html");
  EXPECT_EQ(listFiles(m_folder / "a"), files);
  EXPECT_TRUE(contains(first.out, "fastest with flip.mean <= 0.9, furnace: mobile ")) << first.out;
  nlohmann::json json = nlohmann::json::parse(readWholeFile(m_folder / "a" / "bench.json"));
  ASSERT_EQ(json["scenes"].size(), 1u);
  EXPECT_EQ(json["scenes"][0]["variants"].size(), 3u) << "both defaults and the one asked for";
  EXPECT_FALSE(json["machine"]["device"].get<std::string>().empty());

  // As if all had been a thousand times as fast, or as slow, before.
  for (const double factor : {1e-3, 1e3}) {
    nlohmann::json other = json;
    for (nlohmann::json& variant : other["scenes"][0]["variants"])
      for (nlohmann::json& time : variant["timeMs"]["device"]["rounds"]) time = time.get<double>() * factor;
    const std::string file = path("other.json");
    base::writeText(file, other.dump());
    const RunResult second = runParity(join({kShort, {"--compare", file}}));
    EXPECT_TRUE(exitedWith(factor < 1 ? 2 : 0, second));
    EXPECT_TRUE(contains(second.out, factor < 1 ? "slower: furnace highend: default" : "faster: furnace"))
        << second.out;
  }
}

// Of one round each nothing can be told: that is no pass.
TEST_F(BenchOnDevice, AComparisonThatJudgesNothingFails) {
  ASSERT_TRUE(exitedWith(0, runParity(join({kShort, {"-o", path("a")}}))));
  nlohmann::json json = nlohmann::json::parse(readWholeFile(m_folder / "a" / "bench.json"));
  for (nlohmann::json& variant : json["scenes"][0]["variants"]) {
    nlohmann::json& rounds = variant["timeMs"]["device"]["rounds"];
    rounds = {rounds[0]};
  }
  base::writeText(path("once.json"), json.dump());
  const RunResult result = runParity(join({kShort, {"--compare", path("once.json")}}));
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_TRUE(contains(result.out, "no setting could be judged")) << result.out;
}

// The keys of a suite's scenes are options of each alone.
TEST_F(BenchOnDevice, ABrokenFirstSceneOfASuiteStopsNoOther) {
  const std::string suite = write("suite.toml", R"(
[[scene]]
name = "lost"
file = "builtin:furnace"
[[scene.view]]
name = "left"
camera = "no such camera"
[[scene]]
name = "like the setting"
file = "builtin:furnace"
compensation = "none"
)");
  const RunResult result = runParity({"bench", "--suite", suite, "--size", "24x24", "--rounds", "2", "--no-truth",
                                      "--settings", "highend: compensation none", "-o", path("out"), "--validation"});
  ASSERT_TRUE(exitedWith(4, result));
  EXPECT_TRUE(contains(result.err, "error: lost: ")) << result.err;
  EXPECT_TRUE(contains(result.err, "no such camera")) << result.err;
  const nlohmann::json json = nlohmann::json::parse(readWholeFile(m_folder / "out" / "bench.json"));
  ASSERT_EQ(json["scenes"].size(), 2u);
  EXPECT_TRUE(contains(json["scenes"][0]["failure"], "no such camera"));
  EXPECT_EQ(json["scenes"][1]["variants"].size(), 2u) << "the setting equals this scene's default";
  EXPECT_EQ(json["scenes"][1]["skipped"],
            (std::vector<std::string>{"highend: compensation none: the same as highend: default"}));
  EXPECT_TRUE(contains(readWholeFile(m_folder / "out" / "bench.md"), "- lost: not measured: "));
}

TEST(Bench, ASettingThatNoPathHasIsRefusedBeforeAnySceneIsLoaded) {
  expectRefused(runParity({"bench", "no-such.gltf", "--settings", "desktop*"}), 64, {"--settings desktop*", "--list"});
}

TEST_F(BenchOnDevice, ASuiteIsTriedSceneBySceneEachWithItsKeysAndItsViews) {
  writeFile(m_folder / "suite.toml", R"(
[defaults]
mobile_preset = "refit"
[[scene]]
name = "by night"
file = "builtin:furnace"
environment = "builtin:night"
[[scene]]
name = "rough"
file = "builtin:furnace"
mobile_preset = "karis2014"
[[scene.view]]
name = "left"
orbit = [-40, 70, 0]
[[scene.view]]
name = "right"
orbit = [40, 70, 0]
)");
  const std::vector<std::string> options = {
      "--size",  "24x24",          "--rounds",    "2", "--error", "20%", "--settings", "highend: compensation none",
      "--paths", "highend,mobile", "--validation"};
  const std::filesystem::path folder = m_folder / "out";
  const RunResult result = runParity(join({{"bench", "--suite", path("suite.toml"), "-o", folder.string()}, options}));
  ASSERT_TRUE(exitedWith(0, result));
  const nlohmann::json json = nlohmann::json::parse(readWholeFile(folder / "bench.json"));
  std::vector<std::string> names, environments, presets;
  for (const nlohmann::json& scene : json["scenes"]) {
    names.push_back(scene["scene"]);
    environments.push_back(scene["environment"]);
    ASSERT_EQ(scene["variants"].size(), 3u);
    EXPECT_TRUE(scene["variants"][0]["error"].contains("truth"));
    EXPECT_GT(scene["variants"][0]["cost"]["operations"], 0) << "shaders are counted";
    presets.push_back(scene["variants"][1]["knobs"]["environment-brdf"]);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"by night", "rough, left", "rough, right"}));
  EXPECT_NE(environments[0], environments[1]);
  EXPECT_NE(presets[0], presets[1]) << "[defaults] of the one, a key of the other";
  const std::string table = readWholeFile(folder / "bench.md");
  for (const char* part : {"| highend: compensation none | 3 |", "| by night | rough, left | rough, right |",
                           "- rough, left: the default of mobile has mobile-preset karis2014, but refit in by night."})
    EXPECT_TRUE(contains(table, part)) << part << " in " << table;
}

TEST(Bench, AWrongSuiteIsRefusedWithItsLineAndTheReason) {
  const TempFolder folder;
  const std::string suite = (folder / "suite.toml").string();
  writeFile(suite, "[[scene]]\nfile = \"builtin:furnace\"\nenviroment = \"builtin:sky\"\n");
  expectRefused(runParity({"bench", "--suite", suite}), 4, {"suite.toml", "line 3: enviroment", "'environment'"});
  expectRefused(runParity({"bench", "--suite", "no-such.toml"}), 4, {"no-such.toml"});
  for (const std::vector<std::string>& beside :
       {std::vector<std::string>{"builtin:furnace"}, {"--env", "builtin:sky"}, {"--orbit", "1,2,3"}, {"--scaling"}})
    EXPECT_TRUE(exitedWith(64, runParity(join({{"bench", "--suite", suite}, beside}))));
}

TEST_F(BenchOnDevice, ABudgetThatNoSettingKeepsIsTwoAndABrokenSceneIsFourButLosesNothing) {
  EXPECT_TRUE(exitedWith(2, runParity(join({kShort, {"--budget", "flip.mean=1e-9"}}))));
  const RunResult result = runParity(join({kShort, {"no-such.gltf", "--json", "-"}}));
  ASSERT_TRUE(exitedWith(4, result));
  const nlohmann::json json = nlohmann::json::parse(result.out);
  ASSERT_EQ(json["scenes"].size(), 2u);
  EXPECT_EQ(json["scenes"][0]["variants"].size(), 3u);
  EXPECT_TRUE(contains(json["scenes"][1]["failure"], "no-such.gltf"));
}

TEST(Bench, ListsItsSettings) {
  const RunResult result = runParity({"bench", "--list"});
  ASSERT_TRUE(exitedWith(0, result));
  for (const char* part :
       {"highend: default\n", "mobile: karis2014 fp16\n", "off-specular none", "(needs: environment)"})
    EXPECT_TRUE(contains(result.out, part)) << part;
}

TEST(Bench, RefusesWhatItCannotDo) {
  EXPECT_TRUE(exitedWith(64, runParity({"bench"})));
  EXPECT_TRUE(exitedWith(64, runParity({"bench", "builtin:furnace", "--budget", "ssim=1"})));
  EXPECT_TRUE(exitedWith(64, runParity({"bench", "builtin:furnace", "--scaling"})));
  expectRefused(runParity({"bench", "builtin:furnace", "--compare", "no-such.json"}), 4, {"no-such.json"});
}

} // namespace
} // namespace parity::tests
