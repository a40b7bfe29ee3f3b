// parity stress: short runs of the real program.
#include "cli/checks.h"

namespace parity::tests {
namespace {

const std::vector<std::string> kShortStress = {
    "stress", "--only", "functions", "--functions", "EnvBRDF*", "--points", "2000", "--device-points", "0"};

TEST(Stress, JsonAloneOnStdoutAndKnownFailuresExitZero) {
  const RunResult result = runParity(join({kShortStress, {"--json", "-"}}));
  ASSERT_TRUE(exitedWith(0, result));
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["unexpected"], 0);
  EXPECT_GT(json["expected"], 5);
  EXPECT_EQ(json["functions"].size(), 4u);
  EXPECT_EQ(json["functions"][0]["columns"].size(), 3u) << "no device";
}

TEST(Stress, WritesAFolderThatIsTheSameWithOneThread) {
  const TempFolder folder;
  ASSERT_TRUE(exitedWith(0, runParity(join({kShortStress, {"-o", (folder / "a").string()}}))));
  ASSERT_TRUE(exitedWith(0, runParity(join({kShortStress, {"-o", (folder / "b").string(), "--threads", "1"}}))));
  std::vector<std::string> files = {"index.html", "stress.json"};
  if (!kHasPage) std::erase(files, "index.html");
  EXPECT_EQ(listFiles(folder / "a"), files);
  EXPECT_EQ(readWholeFile(folder / "a" / "stress.json"), readWholeFile(folder / "b" / "stress.json"));
}

TEST(Stress, WhatItReportsCanBeReproduced) {
  const RunResult run = runParity(join({kShortStress, {"--json", "-"}}));
  ASSERT_TRUE(exitedWith(0, run));
  const nlohmann::json json = nlohmann::json::parse(run.out);
  const std::string at = json["functions"][0]["columns"][2]["worstError"]["at"];
  const RunResult result = runParity({"stress", "--device-points", "0", "--at", at});
  ASSERT_TRUE(exitedWith(0, result));
  for (const char* part : {"cpu fp64", "cpu fp32", "cpu fp16"}) EXPECT_TRUE(contains(result.out, part)) << result.out;
  EXPECT_EQ(linesOf(result.out).front(), at);
}

TEST(Stress, ListNamesFunctionsAndScenes) {
  const RunResult result = runParity({"stress", "--list"});
  ASSERT_TRUE(exitedWith(0, result));
  for (const char* part : {"D_Approx", "roughness <= 0.0625", "grows with NoH", "roughness-0", "black-environment"})
    EXPECT_TRUE(contains(result.out, part)) << part;
}

TEST(Stress, RefusesWhatItDoesNotKnow) {
  expectRefused(runParity({"stress", "--functions", "D_GXG", "--only", "functions", "--device-points", "0"}), 64,
                {"D_GXG", "D_GGX"});
  expectRefused(runParity({"stress", "--at", "D_GGX:1"}), 64, {"D_GGX", "needs 2: alpha, NoH"});
  expectRefused(runParity({"stress", "--only", "renders", "--renders", "nothing"}), 64, {"nothing"});
  EXPECT_TRUE(exitedWith(64, runParity({"stress", "--only", "everything"})));
  EXPECT_TRUE(exitedWith(64, runParity({"stress", "--seconds", "1", "--scenes", "2"})));
}

class StressOnDevice : public RenderingTest {};

TEST_F(StressOnDevice, FunctionsAndASceneOnTheDevice) {
  const RunResult result = runParity({"stress", "--functions", "GGX_Mobile", "--points", "1000", "--device-points",
                                      "1000", "--renders", "denormal-light", "--json", "-"});
  ASSERT_TRUE(exitedWith(0, result));
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["functions"][0]["columns"].size(), 5u);
  EXPECT_EQ(json["functions"][0]["columns"][3]["maxUlps"], 0) << "GGX_Mobile is exact in fp32";
  EXPECT_EQ(json["scenes"].size(), 1u);
}

TEST_F(StressOnDevice, AnUnknownDeviceIsAnErrorNotASkip) {
  EXPECT_TRUE(
      exitedWith(4, runParity({"stress", "--only", "renders", "--renders", "backlight", "--device", "no such"})));
}

} // namespace
} // namespace parity::tests
