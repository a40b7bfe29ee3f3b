// Plan, work and merge give the bytes that `report` gives, for every number of shards and workers.
#include <algorithm>
#include <regex>
#include <set>

#include "base/image/image_io.h"
#include "cli/nightly/night.h"

namespace parity::tests {
namespace {

class ShardsTest : public NightTest {
protected:
  // Does all shards, each by a process of its own, as machines would; the report in `to`.
  void doShards(int shards, int jobs, const std::string& to) const {
    plan(shards);
    for (int shard = 0; shard < shards; ++shard)
      EXPECT_TRUE(exitedWith(0, work({"--shard", std::to_string(shard), "--jobs", std::to_string(jobs)})));
    EXPECT_TRUE(isReported(merge(to)));
  }
};

TEST_F(ShardsTest, AnyNumberOfShardsAndWorkersGivesTheSameBytes) {
  constexpr int kScenes = 12;
  writeScenes(kScenes);
  const Files expected = reportHere();
  ASSERT_TRUE(expected.contains("report.json"));
  EXPECT_GE(expected.size(), kScenes * 3u) << "three pictures a scene and more";
  EXPECT_TRUE(contains(expected.at("report.json"), "\"inputs\": {")) << "of the scenes, equal as all else";
  for (const auto& [shards, jobs] : {std::pair(1, 4), {2, 1}, {3, 4}, {7, 1}, {kScenes, 1}}) {
    const std::string to = "merged-" + std::to_string(shards);
    doShards(shards, jobs, to);
    EXPECT_TRUE(sameFiles(reportIn(to), expected)) << shards << " shards, " << jobs << " workers";
  }
}

TEST_F(ShardsTest, ReportOfSeveralWorkersIsTheReportOfOneProcess) {
  writeScenes(6);
  const Files expected = reportHere();
  EXPECT_TRUE(
      isReported(runParity(join({{"report", "-o", path("many"), "--jobs", "2"}, options()}), failing("", false))));
  std::set<std::string> workers; // by their process ids
  for (const std::string& scene : begun()) workers.insert(scene.substr(0, scene.find(' ')));
  EXPECT_EQ(workers.size(), 2u);
  EXPECT_TRUE(sameFiles(reportIn("many"), expected));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "many" / ".parity-work"));
}

// A baseline with other figures, which the budgets judge: no row is over its limit, all have regressed. So what is
// measured further depends on both.
TEST_F(ShardsTest, BaselineAndBudgetsAreThoseOfThePlan) {
  writeScenes(3);
  const std::string budgets = write("budgets.toml", R"([[material]]
name = "*"
min_pixels = 1
checks = [ { metric = "flip.mean", fail = 0.99 } ]
regress = [ { metric = "flip.mean", fail = 0.0001 } ]
)");
  ASSERT_TRUE(isReported(runParity(join({{"report", "-o", path("old")}, options()}))));
  std::string text = readWholeFile(m_folder / "old" / "report.json"); // as if it had been far better
  text = std::regex_replace(text, std::regex("\"flip.mean\": ?[0-9.e-]+"), "\"flip.mean\":0");
  std::filesystem::create_directory(m_folder / "before");
  writeFile(m_folder / "before" / "report.json", text);
  const std::vector<std::string> judged = {"--budgets",    budgets,         "--baseline",
                                           path("before"), "--attribution", "over-budget"};
  const RunResult plain = runParity(join({{"report", "-o", path("plain")}, options(), judged}));
  ASSERT_TRUE(exitedWith(2, plain)) << "all regressed";
  EXPECT_TRUE(contains(reportIn("plain").at("report.json"), "\"attribution\": {"));
  plan(2, judged);
  writeBudgets(m_folder, "fail = 0.9");
  std::filesystem::remove_all(m_folder / "before");
  EXPECT_TRUE(exitedWith(0, work()));
  EXPECT_TRUE(exitedWith(2, merge("merged")));
  EXPECT_TRUE(sameFiles(reportIn("merged"), reportIn("plain")));
}

TEST_F(ShardsTest, PicturesOfWhatPassedCanBeLeftOut) {
  writeScenes(3);
  ASSERT_TRUE(isReported(runParity(join({{"report", "-o", path("all")}, options()}))));
  const std::size_t all = listPictures(readReport(m_folder / "all")).size();
  for (const std::string kept : {"not-passed", "none"}) {
    EXPECT_TRUE(isReported(runParity(join({{"report", "-o", path("plain"), "--pictures", kept}, options()}))));
    plan(2, {"--pictures", kept});
    EXPECT_TRUE(exitedWith(0, work()));
    EXPECT_TRUE(isReported(merge("merged-" + kept)));
    EXPECT_TRUE(sameFiles(reportIn("merged-" + kept), reportIn("plain"))) << kept;
    std::filesystem::remove_all(m_folder / "plain");
  }
  const std::size_t some = listPictures(readReport(m_folder / "merged-not-passed")).size(); // one view of three warns
  EXPECT_GT(some, 0u);
  EXPECT_LT(some, all);
  EXPECT_TRUE(listPictures(readReport(m_folder / "merged-none")).empty());
}

TEST_F(ShardsTest, EachSceneIsInOneShard) {
  writeScenes(10);
  plan(3);
  std::multiset<std::size_t> places;
  const nlohmann::json shards = planFile()["shards"];
  ASSERT_EQ(shards.size(), 3u);
  for (const nlohmann::json& shard : shards)
    for (const nlohmann::json& place : shard) places.insert(place.get<std::size_t>());
  ASSERT_EQ(places.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(places.count(i), 1u) << i;
}

TEST_F(ShardsTest, MissingUnitsAreNamedAndDoneAgain) {
  writeScenes(4);
  const Files expected = reportHere();
  plan(2);
  EXPECT_EQ(runParity({"work", path("night"), "--missing"}).out, "0,1\n");
  EXPECT_TRUE(exitedWith(0, work({"--shard", "1"})));
  EXPECT_EQ(runParity({"work", path("night"), "--missing"}).out, "0\n");
  EXPECT_TRUE(exitedWith(0, work()));
  EXPECT_EQ(runParity({"work", path("night"), "--missing"}).out, "\n");

  std::filesystem::remove(m_folder / "night" / "units" / "000002.unit");
  const RunResult refused = merge("merged");
  EXPECT_TRUE(exitedWith(4, refused));
  EXPECT_TRUE(contains(refused.err, "1 of 4 scenes has no result: '02'")) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(m_folder / "merged" / "report.json"));

  EXPECT_TRUE(exitedWith(4, merge("incomplete", {"--incomplete", "report"})));
  const nlohmann::json report = readReport(m_folder / "incomplete");
  EXPECT_TRUE(contains(report["scenes"][2]["error"]["message"], "has no result")) << report["scenes"][2]["error"];
  EXPECT_TRUE(report["scenes"][1]["error"].is_null());

  std::filesystem::remove(m_folder / "begun.txt");
  EXPECT_TRUE(exitedWith(0, work({}, failing("", false))));
  EXPECT_EQ(begun().size(), 1u) << "only what was missing";
  expectMerged(expected);
}

// The folder of last night's plan: what has changed since is done again, and nothing else.
TEST_F(ShardsTest, PlanMadeAgainSeesChangedFiles) {
  writeScenes(3);
  plan(1);
  EXPECT_TRUE(exitedWith(0, work()));
  GltfFile other = makeQuad();
  other.material()["pbrMetallicRoughness"]["roughnessFactor"] = 0.9;
  std::filesystem::rename(writeEmbedded(m_folder, std::move(other), "other"), m_folder / "01.gltf");
  EXPECT_TRUE(exitedWith(0, runParity(join({{"plan", "-o", path("night")}, options()}))));
  std::filesystem::remove(m_folder / "begun.txt");
  EXPECT_TRUE(exitedWith(0, work({}, failing("", false))));
  EXPECT_EQ(begun().size(), 1u);
  EXPECT_TRUE(isReported(merge("merged")));
  EXPECT_TRUE(sameFiles(reportIn("merged"), reportHere()));
}

TEST_F(ShardsTest, FileThatChangesBetweenShardsIsTold) {
  writeScenes(2);
  GltfFile file = makeQuad();
  file.json["images"] = {{{"uri", "paint.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  for (const char* name : {"00", "01"}) writeExternal(m_folder, file, name);
  base::writeImage8(m_folder / "paint.png", base::Image8(4, 4, 3, 90));
  plan(2);
  EXPECT_TRUE(exitedWith(0, work({"--shard", "0"})));
  base::writeImage8(m_folder / "paint.png", base::Image8(4, 4, 3, 200));
  EXPECT_TRUE(exitedWith(0, work({"--shard", "1"})));
  const RunResult merged = merge("merged");
  EXPECT_TRUE(contains(merged.err, "file 'paint.png' changed while the scenes of the plan were compared"))
      << merged.err;
}

TEST_F(ShardsTest, ClocksMayJump) {
  writeScenes(3);
  const Files expected = reportHere();
  plan(2);
  RunOptions jumping = failing("", false);
  jumping.environment.emplace_back("PARITY_FAULTS_CLOCK", "1");
  EXPECT_TRUE(exitedWith(0, work({"--jobs", "2"}, jumping)));
  EXPECT_TRUE(isReported(merge("merged", {}, jumping)));
  EXPECT_TRUE(sameFiles(reportIn("merged"), expected));
}

} // namespace
} // namespace parity::tests
