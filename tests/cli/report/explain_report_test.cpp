// --explain over-budget: what it adds to a report, and what it leaves alone.
#include <set>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class ExplainReport : public RenderingTest {
protected:
  static json parse(const std::filesystem::path& file) { return json::parse(readWholeFile(file)); }
  // Limits of gold, and of nothing else.
  void limitGold(const std::string& checks) {
    m_budgets =
        write("budgets.toml", "[[material]]\nname = \"gold\"\nchecks = [ " + checks +
                                  " ]\n"
                                  "[[material]]\nname = \"*\"\nchecks = [ { metric = \"flip.mean\", fail = 0.9 } ]\n"
                                  "[[whole]]\nchecks = [ { metric = \"flip.mean\", fail = 0.9 } ]\n");
  }
  std::vector<std::string> command(const std::string& folder) {
    if (m_budgets.empty()) limitGold("{ metric = \"flip.mean\", warn = 0.05, fail = 0.06 }");
    return join({{"report", "builtin:materials", "--env", "builtin:sky", "--size", "96x96", "--budgets", m_budgets,
                  "--no-cache", "-o", path(folder)},
                 kRoughSky});
  }
  std::string m_budgets;
};

TEST_F(ExplainReport, NamesTheApproximationOfWhatIsOverBudgetAndNothingElseChanges) {
  const RunResult plain = runParity(command("plain")),
                  asked = runParity(join({command("asked"), {"--explain", "over-budget"}}));
  EXPECT_TRUE(exitedWith(2, plain)) << plain.err;
  EXPECT_TRUE(exitedWith(2, asked)) << asked.err;
  json report = parse(m_folder / "asked/report.json");
  std::size_t explained = 0;
  for (json& material : report["scenes"][0]["views"][0]["materials"]) {
    if (!material.contains("explanation")) continue;
    ++explained;
    EXPECT_EQ(material["name"], "gold");
    const json& e = material["explanation"];
    EXPECT_EQ(e["sets"][0]["flip"], material["figures"]["metrics"]["flip.mean"]) << "as the report measures it";
    EXPECT_EQ(e["approximations"][0]["approximation"], "environment BRDF and direct lobe");
    EXPECT_GT(e["approximations"][0]["share"].get<double>(), 0.01);
    ASSERT_GT(e["advised"].get<int>(), 0);
    const base::Image8 advised = base::readImage8(m_folder / "asked" / e["picture"].get<std::string>());
    const base::Image8 today = base::readImage8(m_folder / "asked" / material["crops"]["test"].get<std::string>());
    EXPECT_EQ(advised.width, today.width);
    EXPECT_EQ(advised.height, today.height);
    EXPECT_NE(advised.pixels, today.pixels);
    for (const json& mask : e["masks"]) {
      const base::Image8 marked = base::readImage8(m_folder / "asked" / mask["picture"].get<std::string>());
      std::set<int> opacities;
      for (std::size_t i = 3; i < marked.pixels.size(); i += 4) opacities.insert(marked.pixels[i]);
      EXPECT_EQ(opacities.size(), 2u);
    }
    EXPECT_TRUE(contains(asked.out, e["words"].get<std::string>())) << asked.out;
    EXPECT_TRUE(
        contains(readWholeFile(m_folder / "asked/junit.xml"), "approximation: environment BRDF and direct lobe"));
    material.erase("explanation");
  }
  EXPECT_EQ(explained, 1u);
  EXPECT_EQ(report, parse(m_folder / "plain/report.json"));
  EXPECT_FALSE(contains(plain.out, "approximation:"));
}

TEST_F(ExplainReport, IsTheSameFromWorkersAndInDiff) {
  const RunResult one = runParity(join({command("one"), {"--explain", "over-budget"}}));
  const RunResult workers = runParity(join({command("workers"), {"--explain", "over-budget", "--jobs", "1"}}));
  EXPECT_TRUE(exitedWith(2, one)) << one.err;
  EXPECT_TRUE(exitedWith(2, workers)) << workers.err;
  EXPECT_TRUE(readWholeFile(m_folder / "one/report.json") == readWholeFile(m_folder / "workers/report.json"));
  EXPECT_TRUE(exitedWith(0, runParity(join({{"plan", "builtin:materials", "--env", "builtin:sky", "--size", "96x96",
                                             "--budgets", m_budgets, "--no-cache", "-o", path("plan")},
                                            kRoughSky}))));
  EXPECT_TRUE(exitedWith(0, runParity({"work", path("plan"), "-q"})));
  EXPECT_TRUE(
      exitedWith(2, runParity({"merge", path("plan"), "-o", path("merged"), "--explain", "over-budget", "-q"})));
  EXPECT_TRUE(readWholeFile(m_folder / "one/report.json") == readWholeFile(m_folder / "merged/report.json"));
  const RunResult diff =
      runParity(join({{"diff", "builtin:materials", "--env", "builtin:sky", "--size", "96x96", "--budgets", m_budgets,
                       "--explain", "over-budget", "--csv", path("rows.csv")},
                      kRoughSky}));
  EXPECT_TRUE(exitedWith(2, diff)) << diff.err;
  EXPECT_TRUE(contains(diff.out, "approximation: environment BRDF and direct lobe")) << diff.out;
  EXPECT_TRUE(contains(readWholeFile(m_folder / "rows.csv"), "approximation: environment BRDF"));
}

// Nothing is explained where nothing is over budget, and no picture is left over.
TEST_F(ExplainReport, CostsNothingWhereAllPasses) {
  std::vector<std::string> furnace = command("out");
  furnace[1] = "builtin:furnace";
  const RunResult run = runParity(join({furnace, {"--explain", "over-budget"}}));
  EXPECT_TRUE(exitedWith(0, run)) << run.err;
  EXPECT_FALSE(contains(readWholeFile(m_folder / "out/report.json"), "\"explanation\""));
  EXPECT_TRUE(exitedWith(64, runParity({"report", "builtin:furnace", "--explain", "everything"})));
}

TEST_F(ExplainReport, SaysThatAdviceIsByMeanFlip) {
  limitGold("{ metric = \"flip.mean\", fail = 0.9 }, { metric = \"flip.p95\", fail = 0.01 }");
  const RunResult run = runParity(join({command("out"), {"--explain", "over-budget"}}));
  EXPECT_TRUE(exitedWith(2, run)) << run.err;
  EXPECT_TRUE(contains(run.out, "advice is by mean FLIP")) << run.out;
  EXPECT_FALSE(contains(run.out, "operations")) << run.out;
}

// What cannot be explained says why; the report is there all the same.
TEST_F(ExplainReport, SaysWhyItCouldNot) {
  EXPECT_TRUE(exitedWith(0, runParity({"export", "builtin:materials", "-o", path("scene.glb")})));
  std::vector<std::string> words = command("plan");
  words[0] = "plan";
  words[1] = path("scene.glb");
  EXPECT_TRUE(exitedWith(0, runParity(words)));
  EXPECT_TRUE(exitedWith(0, runParity({"work", path("plan"), "-q"})));
  std::filesystem::rename(path("scene.glb"), path("moved.glb"));
  const RunResult merged = runParity({"merge", path("plan"), "-o", path("merged"), "--explain", "over-budget"});
  EXPECT_TRUE(exitedWith(2, merged)) << merged.err;
  EXPECT_TRUE(contains(merged.err, "not explained: ")) << merged.err;
  std::size_t failures = 0;
  const json report = parse(m_folder / "merged/report.json");
  for (const json& material : report["scenes"][0]["views"][0]["materials"])
    if (material.contains("explanation")) {
      EXPECT_TRUE(contains(material["explanation"]["failure"].get<std::string>(), "scene.glb"));
      ++failures;
    }
  EXPECT_EQ(failures, 1u);
}

// The second run takes both from the cache, with the same pictures; another limit asks for another explanation.
TEST_F(ExplainReport, IsKeptInTheCache) {
  const auto run = [&](const std::string& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = join({command(folder), more});
    std::erase(words, "--no-cache");
    const RunResult result =
        runParity(join({words, {"--explain", "over-budget", "--cache", path("cache"), "--timings"}}));
    EXPECT_TRUE(exitedWith(2, result)) << result.err;
    return result;
  };
  const RunResult first = run("first"), second = run("second");
  EXPECT_TRUE(contains(first.err, "shade mobile")) << first.err;
  EXPECT_FALSE(contains(second.err, "shade mobile")) << second.err;
  EXPECT_TRUE(readWholeFile(m_folder / "first/report.json") == readWholeFile(m_folder / "second/report.json"));
  const json report = parse(m_folder / "second/report.json");
  std::size_t pictures = 0;
  for (const json& material : report["scenes"][0]["views"][0]["materials"]) {
    if (!material.contains("explanation")) continue;
    const std::string file = material["explanation"]["picture"];
    EXPECT_TRUE(readWholeFile(m_folder / "first" / file) == readWholeFile(m_folder / "second" / file));
    ++pictures;
  }
  EXPECT_EQ(pictures, 1u);
  limitGold("{ metric = \"flip.mean\", warn = 0.04, fail = 0.06 }");
  EXPECT_TRUE(contains(run("third", {"--single-file"}).err, "shade mobile"));
  EXPECT_TRUE(contains(readWholeFile(m_folder / "third/index.html"), "_advised.png"));
}

} // namespace
} // namespace parity::tests
