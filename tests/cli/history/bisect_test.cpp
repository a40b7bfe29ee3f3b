// git bisect run parity history step: from a repository with a planted change to its commit.
#include <fmt/format.h>

#include "cli/checks.h"
#include "cli/nightly/night.h"
#include "history/git_repository.h"

namespace parity::tests {
namespace {

class BisectTest : public NightTest {
protected:
  void SetUp() override {
    if (!GitRepository::canMake()) GTEST_SKIP() << "git is not installed: scripts/install-deps";
    NightTest::SetUp();
  }
  static double worst(const nlohmann::json& report) {
    return report["scenes"][0]["views"][0]["materials"][0]["figures"]["metrics"]["flip.mean"];
  }
};

TEST_F(BisectTest, FindsTheCommitThatChangedTheScene) {
  const GitRepository repository(m_folder / "repository");
  writeScenes(1);
  const std::string good = readWholeFile(m_folder / "00.gltf");
  nlohmann::json gltf = nlohmann::json::parse(good);
  gltf["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 1;
  gltf["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.6;
  const std::filesystem::path scene = repository.folder() / "scene.gltf", out = m_folder / "out";
  const std::vector<std::string> command = {"report", scene.string(),   "--size", "32x32",
                                            "--env",  "builtin:studio", "-o",     out.string()};
  const auto figure = [&](const std::string& text) {
    writeFile(scene, text);
    EXPECT_TRUE(isReported(runParity(command)));
    return worst(readReport(out));
  };
  const double before = figure(good), after = figure(gltf.dump());
  ASSERT_GT(after, before * 1.2) << "the planted change";
  std::vector<std::string> commits;
  for (int i = 0; i < 9; ++i) {
    writeFile(scene, i < 6 ? good : gltf.dump());
    if (i == 3) writeFile(scene, std::string("this commit cannot be compared"));
    writeFile(repository.folder() / "notes.txt", std::to_string(i));
    commits.push_back(repository.commit(fmt::format("change {}", i)));
  }
  repository.run({"bisect", "start", commits.back(), commits.front()});
  const std::vector<std::string> output =
      repository.run(join({{"bisect", "run", parityExecutable().string(), "history", "step", out.string(), "--at-most",
                            fmt::format("flip.mean={}", (before + after) / 2), "--", parityExecutable().string()},
                           command}));
  std::string all;
  for (const std::string& line : output) all += line + "\n";
  EXPECT_TRUE(contains(all, commits[6] + " is the first bad commit")) << all;
}

TEST_F(BisectTest, ExitCodesAreThoseOfGit) {
  writeScenes(1);
  ASSERT_TRUE(isReported(runParity(join({{"report", "-o", path("out")}, options()}))));
  const auto step = [&](const std::vector<std::string>& more) {
    return runParity(join({{"history", "step", path("out")}, more}));
  };
  EXPECT_TRUE(exitedWith(0, step({"--at-most", "flip.mean=1"})));
  EXPECT_TRUE(exitedWith(1, step({"--at-most", "flip.max=0", "--at-most", "flip.mean=1"})));
  EXPECT_TRUE(exitedWith(125, step({"--at-most", "flip.mean=1", "--only", "Nobody"})));
  EXPECT_TRUE(exitedWith(125, step({"--at-most", "flip.mean=1", "--", "/no/program"})));
  const RunResult stale = step({"--at-most", "flip.mean=1", "--", "true"});
  EXPECT_TRUE(exitedWith(125, stale));
  EXPECT_TRUE(contains(stale.err, "wrote no")) << "a report of another commit: " << stale.err;
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{}, {"--at-most", "flip.men=1"}, {"--at-mots", "flip.mean=1"}})
    EXPECT_TRUE(exitedWith(128, step(wrong))) << "64 would be bad";
  std::filesystem::remove(m_folder / "out" / "report.json");
  EXPECT_TRUE(exitedWith(125, step({"--at-most", "flip.mean=1"})));
}

} // namespace
} // namespace parity::tests
