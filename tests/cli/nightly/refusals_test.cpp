// What plan, work and merge refuse: in one line, with the exit code of docs/nightly.md, and nothing that was done is
// lost.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "cli/nightly/night.h"

namespace parity::tests {
namespace {

class RefusalsTest : public NightTest {
protected:
  std::filesystem::path night() const { return m_folder / "night"; }
  void editPlan(const std::string& from, const std::string& to) const {
    std::string text = readWholeFile(night() / "plan.json");
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    writeFile(night() / "plan.json", text.replace(at, from.size(), to));
  }
  // The value of a key of plan.json, as it stands there.
  std::string planned(const std::string& key) const { return planFile()[key].get<std::string>(); }
};

TEST_F(RefusalsTest, PlanOfAnotherBuild) {
  writeScenes(2);
  plan(1);
  editPlan(planned("build"), std::string(32, '0'));
  expectRefused(work(), 78, {"plan.json", "was made by another build of parity"});
  expectRefused(merge("merged"), 78, {"plan.json", "was made by another build of parity"});
}

TEST_F(RefusalsTest, PlanOfAMachineThatRoundsOtherwise) {
  writeScenes(2);
  plan(1);
  editPlan(planned("numerics"), std::string(32, '0'));
  const RunResult run = work();
  EXPECT_TRUE(exitedWith(78, run));
  EXPECT_TRUE(contains(run.err, "was made on a machine that rounds otherwise (numerics id 00000000")) << run.err;
  EXPECT_TRUE(units().empty());
}

TEST_F(RefusalsTest, UnitsOfAnotherPlan) {
  writeScenes(2);
  plan(1);
  EXPECT_TRUE(exitedWith(0, work()));
  const std::string other = readWholeFile(night() / "units" / "000001.unit");
  plan(1, {"--exposure", "1"});
  EXPECT_TRUE(exitedWith(0, work()));
  writeFile(night() / "units" / "000001.unit", other);
  expectRefused(merge("merged"), 78, {"000001.unit", "is of another plan"});
}

TEST_F(RefusalsTest, BaselineThatIsNotThePlansOwn) {
  writeScenes(1);
  ASSERT_TRUE(isReported(runParity(join({{"report", "-o", path("old")}, options()}))));
  plan(1, {"--baseline", path("old")});
  const std::filesystem::path part = night() / "baseline" / "000000.json";
  const std::string whole = readWholeFile(part);
  writeFile(part, whole + " ");
  const RunResult run = work();
  EXPECT_TRUE(exitedWith(78, run));
  EXPECT_TRUE(contains(run.err, "000000.json: is not the baseline of the plan")) << run.err;
  writeFile(part, whole);
  EXPECT_TRUE(exitedWith(0, work()));
  writeFile(night() / "baseline.json", readWholeFile(night() / "baseline.json") + " ");
  expectRefused(merge("merged"), 78, {"baseline.json", "is not the baseline of the plan"});
}

TEST_F(RefusalsTest, EditedUnitsAreDoneAgain) {
  writeScenes(2);
  const Files expected = reportHere();
  plan(1);
  EXPECT_TRUE(exitedWith(0, work()));
  const std::filesystem::path unit = night() / "units" / "000001.unit";
  std::string bytes = readWholeFile(unit);
  bytes[bytes.size() / 2] ^= 1;
  writeFile(unit, bytes);
  expectRefused(merge("merged"), 4, {"1 of 2 scenes has no result: '01'"});
  EXPECT_TRUE(exitedWith(0, work()));
  expectMerged(expected);
}

TEST_F(RefusalsTest, ForeignFilesInTheFolderAreLeftAlone) {
  writeScenes(2);
  const Files expected = reportHere();
  plan(1);
  std::filesystem::create_directory(night() / "units");
  writeFile(night() / "units" / "notes.txt", std::string("mine"));
  writeFile(night() / "units" / "999999.unit", std::string("mine"));
  EXPECT_TRUE(exitedWith(0, work()));
  expectMerged(expected);
  EXPECT_EQ(readWholeFile(night() / "units" / "notes.txt"), "mine");
}

TEST_F(RefusalsTest, SecondMergeAtTheSameTime) {
  writeScenes(1);
  plan(1);
  EXPECT_TRUE(exitedWith(0, work()));
  const int file = ::open((night() / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  ASSERT_EQ(::flock(file, LOCK_EX), 0);
  expectRefused(merge("merged"), 75, {"another process merges this plan"});
  ::close(file);
  EXPECT_TRUE(isReported(merge("merged")));
}

// Also with other options, of which the second one would begin anew.
TEST_F(RefusalsTest, SecondReportIntoTheSameFolderAtTheSameTime) {
  writeScenes(1);
  std::filesystem::create_directories(m_folder / "out" / ".parity-work");
  const int file = ::open((m_folder / "out" / ".parity-work" / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  ASSERT_EQ(::flock(file, LOCK_EX), 0);
  expectRefused(runParity(join({{"report", "-o", path("out"), "--jobs", "1"}, options()})), 75,
                {"another process merges this plan"});
  ::close(file);
  EXPECT_TRUE(isReported(runParity(join({{"report", "-o", path("out"), "--jobs", "1"}, options()}))));
}

TEST_F(RefusalsTest, FullDiskInEachStep) {
  writeScenes(2);
  const Files expected = reportHere();
  const RunResult planned = runParity(join({{"plan", "-o", path("night")}, options()}), failing("full night", false));
  EXPECT_TRUE(exitedWith(4, planned));
  EXPECT_TRUE(contains(planned.err, "plan.json") && contains(planned.err, "No space left on device")) << planned.err;
  plan(1);
  for (const std::string folder : {"pictures", "units"}) {
    const RunResult run = work({}, failing("full " + folder, false));
    EXPECT_TRUE(exitedWith(75, run));
    EXPECT_TRUE(contains(run.err, "No space left on device")) << run.err;
    EXPECT_TRUE(units().empty());
  }
  EXPECT_TRUE(exitedWith(0, work()));
  const RunResult merged = merge("merged", {}, failing("full merged", false));
  EXPECT_TRUE(exitedWith(4, merged));
  EXPECT_TRUE(contains(merged.err, "No space left on device")) << merged.err;
  expectMerged(expected);
}

TEST_F(RefusalsTest, DifferentFiguresOfTwoWorkersAreTold) {
  writeScenes(2);
  reportHere();
  plan(1);
  EXPECT_TRUE(exitedWith(0, work()));
  EXPECT_TRUE(exitedWith(0, work({"--unit", "1"})));
  EXPECT_TRUE(isReported(merge("same")));
  EXPECT_TRUE(sameFiles(reportIn("same"), reportIn("plain"))) << "a second worker that finds the same is no event";
  writeScenes(1);
  GltfFile other = makeQuad();
  other.material()["pbrMetallicRoughness"]["roughnessFactor"] = 0.9;
  std::filesystem::rename(writeEmbedded(m_folder, std::move(other), "other"), m_folder / "01.gltf");
  EXPECT_TRUE(exitedWith(0, work({"--unit", "1"})));
  const RunResult merged = merge("merged");
  EXPECT_TRUE(contains(merged.err, "scene '01' came out in two ways (nondeterminism)")) << merged.err;
  EXPECT_EQ(readReport(m_folder / "merged")["scenes"], readReport(m_folder / "plain")["scenes"])
      << "the first one stays";
}

TEST_F(RefusalsTest, CacheThatIsTooSmallForTheResultsIsToldByThePlan) {
  const std::vector<std::string> command = {
      "plan", "builtin:furnace", "--size", "1024x1024", "--cache", path("cache"), "-o", path("night"), "--cache-size"};
  EXPECT_TRUE(contains(runParity(join({command, {"5M"}})).err, "(--cache-size): the next run will find few of them"));
  std::filesystem::remove_all(night());
  EXPECT_EQ(runParity(join({command, {"5G"}})).err, "");
}

TEST_F(RefusalsTest, WhatIsNotThereIsToldByThePlan) {
  const RunResult result = runParity(
      {"plan", "builtin:furnace", "builtin:furnce", "gone.glb", "--env", "builtin:studoi", "-o", path("night")});
  EXPECT_TRUE(exitedWith(0, result));
  for (const std::string name : {"builtin:furnce", "gone.glb", "builtin:studoi"})
    EXPECT_TRUE(contains(result.err, "warning: " + name + ": is not there")) << result.err;
  EXPECT_EQ(linesOf(result.err).size(), 3u) << result.err;
}

TEST_F(RefusalsTest, PlansThatCannotBe) {
  writeScenes(1);
  plan(1);
  expectRefused(runParity(join({{"plan", "-o", path("night"), "--exposure", "1"}, options()})), 64,
                {"plan.json", "the folder holds another plan"});
  EXPECT_TRUE(exitedWith(0, runParity(join({{"plan", "-o", path("night")}, options()})))) << "the same plan again";
  write("none.toml", "name = \"none\"\n");
  expectRefused(runParity({"plan", "-o", path("empty"), "--suite", path("none.toml")}), 4, {"none.toml"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "empty"));
  EXPECT_TRUE(exitedWith(64, runParity({"report", "builtin:furnace", "--timeout", "3s"}))) << "without --jobs";
  expectRefused(work({"--shard", "1"}), 64, {"--shard", "there is no shard 1: the plan has 1 (0 to 0)"});
  RunOptions array;
  array.environment = {{"SLURM_ARRAY_TASK_ID", "7"}};
  expectRefused(work({"--shard", "auto"}, array), 64, {"SLURM_ARRAY_TASK_ID", "there is no shard 7"});
  expectRefused(runParity({"work", path("nothing")}), 4, {"plan.json", "does not exist"});
  writeFile(night() / "plan.json", std::string("{\"format\": 1"));
  expectRefused(work(), 4, {"plan.json", "is damaged, or a plan of another version"});
}

} // namespace
} // namespace parity::tests
