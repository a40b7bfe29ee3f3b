// A driver that crashes, hangs or takes all memory costs one scene, and the report says which, how and where.
#include <fmt/format.h>
#include <pugixml.hpp>

#include "cli/nightly/night.h"

namespace parity::tests {
namespace {

class CrashTest : public NightTest {
protected:
  // All scenes but that of the fault are as in the plain report; its error is returned.
  std::string onlyErrorIs(const nlohmann::json& report, std::size_t failed) const {
    const nlohmann::json plain = readReport(m_folder / "plain");
    EXPECT_EQ(report["scenes"].size(), plain["scenes"].size());
    for (std::size_t i = 0; i < plain["scenes"].size(); ++i)
      if (i != failed) {
        EXPECT_EQ(report["scenes"][i], plain["scenes"][i]) << i;
      }
    const nlohmann::json& scene = report["scenes"][failed];
    EXPECT_EQ(scene["verdict"], "error");
    EXPECT_EQ(scene["error"]["exitCode"], 4);
    return scene["error"].is_null() ? std::string() : scene["error"]["message"].get<std::string>();
  }
};

TEST_F(CrashTest, OneSceneThatAlwaysCrashesCostsThatScene) {
  writeScenes(24);
  reportHere();
  plan(1);
  const RunResult run = work({"--jobs", "2"}, failing("segv 07.gltf", false));
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_TRUE(contains(run.err, "failed twice")) << run.err;
  const RunResult merged = merge("merged");
  EXPECT_TRUE(exitedWith(4, merged));
  const std::string error = onlyErrorIs(readReport(m_folder / "merged"), 7);
  EXPECT_TRUE(contains(error, "crashed with SIGSEGV")) << error;
  EXPECT_TRUE(contains(error, " at '")) << "the stage: " << error;
  EXPECT_TRUE(contains(error, "the driver says: segv")) << "the end of its stderr: " << error;
  pugi::xml_document junit;
  ASSERT_TRUE(junit.load_file((m_folder / "merged" / "junit.xml").c_str()));
  const pugi::xpath_node_set errors = junit.select_nodes("//testcase/error");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(contains(errors[0].node().attribute("message").value(), "crashed with SIGSEGV"));
  if (kHasPage) {
    EXPECT_TRUE(contains(readWholeFile(m_folder / "merged" / "index.html"), "crashed with SIGSEGV"));
  }
}

TEST_F(CrashTest, EachKindOfFaultIsNamed) {
  writeScenes(3);
  reportHere();
  for (const auto& [fault, words, more] : std::vector<std::tuple<std::string, std::string, std::vector<std::string>>>{
           {"abort", "crashed with SIGABRT", {}},
           {"exit", "ended with exit code 3", {}},
           {"stop", "took longer than 3 s (--timeout)", {"--timeout", "3s"}},
           {"memory", "took more than 1536 MiB of memory (--memory)", {"--memory", "1536M"}}}) {
    plan(1);
    EXPECT_TRUE(exitedWith(0, work(more, failing(fault + " 01.gltf", false)))) << fault;
    EXPECT_TRUE(exitedWith(4, merge("merged"))) << fault;
    const std::string error = onlyErrorIs(readReport(m_folder / "merged"), 1);
    EXPECT_TRUE(contains(error, words)) << error;
  }
}

TEST_F(CrashTest, ReportWithWorkersKeepsTheOtherScenesToo) {
  writeScenes(3);
  reportHere();
  RunOptions failed = failing("abort 02.gltf", false);
  const RunResult run = runParity(join({{"report", "-o", path("out"), "--jobs", "2"}, options()}), failed);
  EXPECT_TRUE(exitedWith(4, run));
  EXPECT_TRUE(contains(onlyErrorIs(readReport(m_folder / "out"), 2), "crashed with SIGABRT"));
}

TEST_F(CrashTest, SecondTryThatSucceedsIsAFlakyCrash) {
  writeScenes(3);
  const Files expected = reportHere();
  plan(1);
  const RunResult run = work({}, failing("segv 01.gltf", true));
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_TRUE(contains(run.err, "warning: 01: flaky crash: crashed with SIGSEGV")) << run.err;
  expectMerged(expected);
  const nlohmann::json info = nlohmann::json::parse(readWholeFile(m_folder / "merged" / "run.json"));
  ASSERT_EQ(info["incidents"].size(), 1u);
  EXPECT_TRUE(contains(info["incidents"][0], "01: flaky crash: a worker crashed with SIGSEGV")) << info["incidents"];
}

// On another machine, or by hand.
TEST_F(CrashTest, SceneThatCrashedTwiceCanBeDoneLater) {
  writeScenes(2);
  const Files expected = reportHere();
  plan(1);
  EXPECT_TRUE(exitedWith(0, work({}, failing("segv 01.gltf", false))));
  EXPECT_TRUE(exitedWith(0, work({"--unit", "1"})));
  expectMerged(expected);
}

TEST_F(CrashTest, WorkersThatATaskManagerEndsBlameNoScene) {
  writeScenes(3);
  const Files expected = reportHere();
  plan(1);
  const RunResult run = work({}, failing("term 01.gltf", true));
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_FALSE(contains(run.err, "crash")) << run.err;
  expectMerged(expected);
}

// Something that ends the workers of one scene each time, such as a guard of the machine's memory.
TEST_F(CrashTest, WorkersOfOneSceneThatAreEndedAgainAndAgainAreItsError) {
  writeScenes(2);
  reportHere();
  plan(1);
  EXPECT_TRUE(exitedWith(0, work({}, failing("term 01.gltf", false))));
  EXPECT_TRUE(exitedWith(4, merge("merged")));
  EXPECT_TRUE(contains(onlyErrorIs(readReport(m_folder / "merged"), 1), "ended with exit code 143"));
}

// A scene that takes the whole machine down, the supervisor too, is never noted as a crash.
TEST_F(CrashTest, SceneThatEndsTheWholeMachineKeepsNoOtherFromBeingDone) {
  writeScenes(4);
  plan(1);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(work({"--jobs", "2"}, failing("parent 00.gltf", false)).signal, SIGKILL);
  EXPECT_EQ(units(), (std::vector<std::string>{"units/000001.unit", "units/000002.unit", "units/000003.unit"}));
}

TEST_F(CrashTest, CrashAfterTheWorkCostsNothing) {
  writeScenes(3);
  const Files expected = reportHere();
  plan(1);
  const RunResult run = work({}, failing("late 02.gltf", false));
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_FALSE(contains(run.err, "crash")) << run.err;
  expectMerged(expected);
}

TEST_F(CrashTest, OrdinaryErrorIsNotTriedAgain) {
  writeScenes(3);
  write("01.gltf", "{");
  ASSERT_TRUE(exitedWith(4, runParity(join({{"report", "-o", path("plain")}, options()}))));
  plan(1);
  EXPECT_TRUE(exitedWith(0, work({}, failing("", false))));
  EXPECT_EQ(begun().size(), 3u);
  EXPECT_TRUE(exitedWith(4, merge("merged")));
  EXPECT_TRUE(sameFiles(reportIn("merged"), reportIn("plain")));
}

TEST_F(CrashTest, DeadDeviceStopsTheWorkAndBlamesNoScene) {
  writeScenes(20);
  plan(1);
  const RunResult run = work({"--jobs", "2"}, failing("kill *.gltf", false));
  EXPECT_TRUE(exitedWith(75, run));
  EXPECT_TRUE(contains(run.err, "32 workers failed in a row, so the device is taken for dead")) << run.err;
  EXPECT_TRUE(units().empty());
}

} // namespace
} // namespace parity::tests
