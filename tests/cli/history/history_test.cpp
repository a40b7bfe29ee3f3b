// parity history on real reports: what changed between them, and why.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "cli/nightly/night.h"

namespace parity::tests {
namespace {

class HistoryCommandTest : public NightTest {
protected:
  RunResult history(const std::vector<std::string>& arguments, const RunOptions& options = {}) const {
    return runParity(join({{"history"}, arguments, {"--history", path("history")}}), options);
  }
  void report(const std::vector<std::string>& more = {}) const {
    ASSERT_TRUE(isReported(runParity(join({{"report", "-o", path("out")}, options(), more}))));
  }
  // Runs are told apart by the second in which they start.
  void setStarted(const std::string& time, const std::string& folder = "out") const {
    nlohmann::json run = nlohmann::json::parse(readWholeFile(m_folder / folder / "run.json"));
    run["startedAt"] = time;
    writeFile(m_folder / folder / "run.json", run.dump());
  }
  RunResult addNight(int day) const {
    setStarted(fmt::format("2026-11-{:02}T03:00:00Z", day));
    return history({"add", path("out"), "--branch", "main", "--commit", fmt::format("{:040x}", day)});
  }
  nlohmann::json blame(const std::string& row) const {
    const RunResult run = history({"blame", row, "--json", "-"});
    EXPECT_TRUE(exitedWith(0, run));
    return nlohmann::json::parse(run.out);
  }
  static std::vector<std::string> causes(const nlohmann::json& blame) {
    std::vector<std::string> names;
    for (const auto& each : blame["inputs"]) names.push_back(each["what"]);
    return names;
  }
  void recolour(const std::string& file) const {
    nlohmann::json gltf = nlohmann::json::parse(readWholeFile(m_folder / file));
    gltf["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.9;
    writeFile(m_folder / file, gltf.dump());
  }
};

TEST_F(HistoryCommandTest, AChangedAssetIsBlamedAndEqualNightsSayNothing) {
  writeScenes(2);
  report();
  const std::string row =
      "01/auto/" + readReport(m_folder / "out")["scenes"][1]["views"][0]["materials"][0]["name"].get<std::string>();
  RunResult run = addNight(1);
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_TRUE(contains(run.out, "the first run of its suite and branch")) << run.out;
  EXPECT_TRUE(contains(history({"add", path("out"), "--branch", "main", "--commit", fmt::format("{:040x}", 1)}).out,
                       "is in the history already"));
  report();
  run = addNight(2);
  EXPECT_TRUE(contains(run.out, "nothing changed")) << run.out;
  recolour("01.gltf");
  report();
  run = addNight(3);
  EXPECT_TRUE(contains(run.out, "cause: asset")) << run.out;
  EXPECT_FALSE(contains(run.out, "  00/")) << run.out;
  EXPECT_EQ(run.err, "");
  const nlohmann::json found = blame(row);
  EXPECT_EQ(found["now"]["commit"], fmt::format("{:040x}", 3));
  EXPECT_EQ(found["before"]["commit"], fmt::format("{:040x}", 2));
  EXPECT_EQ(causes(found), std::vector<std::string>{"asset"});
  EXPECT_EQ(found["nondeterministic"], false);
  run = history({"blame", row});
  EXPECT_TRUE(contains(run.out, "  asset     ")) << run.out;
  EXPECT_TRUE(contains(history({"show"}).out, "nothing changed"));
  EXPECT_TRUE(contains(history({"show", row}).out, "flip.mean"));
  EXPECT_TRUE(contains(history({"rebuild"}).out, "made from 3 runs"));
  EXPECT_EQ(blame(row), found);
}

TEST_F(HistoryCommandTest, RequestAndSettingsAreCauses) {
  writeScenes(1);
  report();
  const std::string row =
      "00/auto/" + readReport(m_folder / "out")["scenes"][0]["views"][0]["materials"][0]["name"].get<std::string>();
  addNight(1);
  write("night.toml", "name = \"night\"\n[defaults]\nsun = [20, 20, 9]\n[[scene]]\nfiles = [\"*.gltf\"]\n");
  report();
  addNight(2);
  EXPECT_EQ(causes(blame(row)), std::vector<std::string>{"request"});
  report({"--exposure", "2"});
  addNight(3);
  EXPECT_EQ(causes(blame(row)), std::vector<std::string>{"settings"});
}

TEST_F(HistoryCommandTest, ASummaryCountsTheNightsOfARow) {
  writeScenes(1);
  write("zero.toml",
        "[[material]]\nname = \"*\"\nmin_pixels = 1\nchecks = [ { metric = \"flip.mean\", fail = 1e-6 } ]\n");
  const std::vector<std::string> strict = {"--budgets", path("zero.toml")};
  for (const int night : {1, 2}) {
    report(strict);
    addNight(night);
  }
  report(join({strict, {"--summary", path("s.md"), "--history", path("history")}}));
  const std::string summary = readWholeFile(m_folder / "s.md");
  EXPECT_TRUE(contains(summary, "### Still failing")) << summary;
  EXPECT_TRUE(contains(summary, "3 nights")) << summary;
  const RunResult none = runParity(join(
      {{"report", "-o", path("out")}, options(), strict, {"--summary", path("s.md"), "--history", path("nowhere")}}));
  EXPECT_TRUE(contains(none.err, "the history cannot be used: ")) << none.err;
  EXPECT_TRUE(contains(readWholeFile(m_folder / "s.md"), "### Failures"));
}

// A block of data of a page.
nlohmann::json blockOf(const std::string& page, const std::string& id) {
  const std::string begin = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t at = page.find(begin);
  if (at == std::string::npos) return {};
  const std::size_t from = at + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST_F(HistoryCommandTest, OnlyFailuresThatTheLastNightDidNotHaveCount) {
  writeScenes(2);
  write("one.toml", "[[material]]\nscene = \"00\"\nname = \"*\"\nmin_pixels = 1\n"
                    "checks = [ { metric = \"flip.mean\", fail = 1e-6 } ]\n");
  write("all.toml",
        "[[material]]\nname = \"*\"\nmin_pixels = 1\nchecks = [ { metric = \"flip.mean\", fail = 1e-6 } ]\n");
  const auto night = [&](const char* budgets, const std::vector<std::string>& more) {
    return runParity(join({{"report", "-o", path("out")}, options(), {"--budgets", path(budgets)}, more}));
  };
  const std::vector<std::string> onlyNew = {"--history", path("history"), "--fail-on", "new"};
  RunResult run = night("one.toml", onlyNew);
  EXPECT_TRUE(exitedWith(4, run)) << "there is no history yet";
  EXPECT_TRUE(contains(run.err, "nobody can tell which failures are new")) << run.err;
  addNight(1);
  run = night("one.toml", onlyNew);
  EXPECT_TRUE(exitedWith(0, run));
  EXPECT_TRUE(contains(run.out, "0 new failures, 1 still failing, not counted")) << run.out;
  addNight(2);
  run = night("all.toml", onlyNew);
  EXPECT_TRUE(exitedWith(2, run));
  EXPECT_TRUE(contains(run.out, "1 new failure, 1 still failing, not counted")) << run.out;
  run = runParity(join({{"diff"}, options(), {"--budgets", path("all.toml")}, onlyNew}));
  EXPECT_TRUE(exitedWith(2, run));
  EXPECT_TRUE(contains(run.out, "1 new failure, 1 still failing, not counted")) << run.out;

  EXPECT_TRUE(exitedWith(0, plan(2, {"--budgets", path("all.toml")})));
  EXPECT_TRUE(exitedWith(0, work({"--shard", "0"})));
  EXPECT_TRUE(exitedWith(0, work({"--shard", "1"})));
  run = merge("merged", onlyNew);
  EXPECT_TRUE(exitedWith(2, run));
  EXPECT_TRUE(contains(run.out, "1 new failure, 1 still failing, not counted")) << run.out;
}

#ifdef PARITY_DASHBOARD
TEST_F(HistoryCommandTest, PagesShowTheRuns) {
  writeScenes(1);
  for (const int night : {1, 2}) {
    if (night == 2) recolour("00.gltf");
    report();
    addNight(night);
  }
  report({"--history", path("history")});
  const std::string page = readWholeFile(m_folder / "out" / "index.html");
  EXPECT_EQ(blockOf(page, "history")["runs"].size(), 2u);
  const std::string scene = readWholeFile(m_folder / "out" / "scenes" / "0.js");
  const nlohmann::json trend = nlohmann::json::parse(
      scene.substr(scene.find('{'), scene.rfind('}') - scene.find('{') + 1))["history"]["views"][0][0];
  EXPECT_EQ(trend["figures"]["flip.mean"].size(), 2u) << trend;
  EXPECT_EQ(trend["changes"][0]["cause"], "asset") << trend;
  report();
  EXPECT_TRUE(blockOf(readWholeFile(m_folder / "out" / "index.html"), "history").is_null());

  RunResult run = history({"page", "-o", path("nights")});
  EXPECT_TRUE(exitedWith(0, run));
  const nlohmann::json nights = blockOf(readWholeFile(m_folder / "nights" / "index.html"), "nights");
  EXPECT_EQ(nights["runs"].size(), 2u);
  EXPECT_GT(nights["rows"].size(), 0u);
  run = history({"page", "-o", path("out")});
  EXPECT_TRUE(exitedWith(4, run));
  EXPECT_TRUE(contains(run.err, "a report lies here, whose page would be lost")) << run.err;
  EXPECT_TRUE(
      exitedWith(0, history({"page", "-o", path("last"), "--last", "1", "--branch", "main", "--suite", "night"})));
  EXPECT_EQ(blockOf(readWholeFile(m_folder / "last" / "index.html"), "nights")["runs"].size(), 1u);
}

// The states of an approval: the one that was approved, and today's.
TEST_F(HistoryCommandTest, ThePageShowsTheApprovedStateBesideTodays) {
  writeScenes(1);
  write("zero.toml",
        "[[material]]\nname = \"*\"\nmin_pixels = 1\nchecks = [ { metric = \"flip.mean\", fail = 1e-6 } ]\n");
  const std::vector<std::string> strict = {"--budgets", path("zero.toml")};
  report(strict);
  addNight(1);
  ASSERT_TRUE(exitedWith(0, runParity({"approve", path("out"), "--material", "*", "--owner", "me", "--reason", "why",
                                       "--until", "2099-01-01", "-o", path("approvals.toml")})));
  recolour("00.gltf");
  report(join({strict, {"--approvals", path("approvals.toml"), "--history", path("history")}}));
  const auto approved = [&] { return listFiles(m_folder / "out" / "approved").size(); };
  EXPECT_EQ(approved(), 3u) << "reference, test, FLIP";
  EXPECT_TRUE(contains(readWholeFile(m_folder / "out" / "scenes" / "0.js"), "\"approved\":{\"run\":0"));
  EXPECT_TRUE(exitedWith(0, history({"gc", "--approvals", path("approvals.toml")})));
  write("approvals.toml", "<<<<<<< HEAD\n");
  EXPECT_TRUE(exitedWith(4, history({"gc", "--approvals", path("approvals.toml")})));
  report(strict);
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out" / "approved")) << "an older report's pictures are removed";
}
#endif

TEST_F(HistoryCommandTest, InputsAreTheSameHoweverTheReportWasMade) {
  writeScenes(3);
  const Files expected = reportHere();
  EXPECT_TRUE(contains(expected.at("report.json"), "\"asset\""));
  ASSERT_TRUE(isReported(runParity(join({{"report", "-o", path("jobs"), "--jobs", "2"}, options()}))));
  EXPECT_TRUE(sameFiles(reportIn("jobs"), expected));
  const auto origin = [&](const std::string& folder) {
    return nlohmann::json::parse(readWholeFile(m_folder / folder / "run.json"))["origin"];
  };
  for (const char* key : {"build", "driver", "numerics", "machine", "whole", "complete"}) {
    EXPECT_EQ(origin("jobs")[key], origin("plain")[key]) << key;
    EXPECT_NE(origin("plain")[key], "") << key;
  }
  EXPECT_GT(origin("plain")["cpuSeconds"], 0);
  const nlohmann::json times = nlohmann::json::parse(readWholeFile(m_folder / "jobs" / "run.json"))["sceneTimes"];
  EXPECT_GT(times[0]["cpuSeconds"], 0) << "a worker has one scene at a time";
  ASSERT_TRUE(isReported(runParity(join({{"report", "-o", path("part"), "--only", "00"}, options()}))));
  EXPECT_EQ(origin("part")["whole"], false);
}

TEST_F(HistoryCommandTest, WhatIsNoReportIsRefused) {
  expectRefused(history({"add", path("nothing")}), 4, {"nothing", "is no folder of a report"});
  std::filesystem::create_directories(m_folder / "out");
  writeFile(m_folder / "out" / "report.json", std::string("{}"));
  expectRefused(history({"add", path("out")}), 4, {"run.json", "does not exist"});
  writeFile(m_folder / "out" / "run.json", std::string("{\"schema\": 4"));
  expectRefused(history({"add", path("out")}), 4, {"run.json", "is not JSON"});
  expectRefused(history({"show"}), 4, {"is no history"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "history"));
}

TEST_F(HistoryCommandTest, AnInterruptedReportIsKeptAndLosesNothing) {
  writeScenes(2);
  report();
  addNight(1);
  nlohmann::json run = nlohmann::json::parse(readWholeFile(m_folder / "out" / "run.json"));
  run["origin"]["complete"] = false;
  writeFile(m_folder / "out" / "run.json", run.dump());
  nlohmann::json report_ = readReport(m_folder / "out");
  report_["scenes"].erase(1);
  writeFile(m_folder / "out" / "report.json", report_.dump());
  const RunResult added = addNight(2);
  EXPECT_TRUE(contains(added.out, "nothing changed; it is incomplete")) << added.out;
}

TEST_F(HistoryCommandTest, TwoWritersAndAFullDiskAreTold) {
  writeScenes(1);
  report();
  addNight(1);
  const int lock = ::open(path("history/lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  expectRefused(addNight(2), 75, {"another process writes this history"});
  ::close(lock);
  RunOptions full = failing("full runs", false);
  setStarted("2026-11-03T03:00:00Z");
  expectRefused(history({"add", path("out")}, full), 4, {"runs", "No space left on device"});
  EXPECT_FALSE(contains(history({"show"}).out, "20261103"));
  EXPECT_TRUE(exitedWith(0, history({"add", path("out")})));
  EXPECT_TRUE(contains(history({"show"}).out, "20261103"));
}

TEST_F(HistoryCommandTest, PicturesOfStatesAreKeptAndCollected) {
  writeScenes(1);
  report();
  setStarted("2026-01-01T03:00:00Z");
  EXPECT_TRUE(exitedWith(0, history({"add", path("out"), "--pictures", "all"})));
  const auto pictures = [&] { return listFiles(m_folder / "history" / "pictures").size(); };
  const std::size_t first = pictures();
  EXPECT_GT(first, 1u);
  for (int i = 0; i < 2; ++i) { // other pictures, the same verdicts
    report({"--exposure", i == 0 ? "0.01" : "0.02"});
    setStarted(i == 0 ? "2026-01-02T03:00:00Z" : "2026-11-24T03:00:00Z");
    EXPECT_TRUE(exitedWith(0, history({"add", path("out"), "--pictures", "all"})));
  }
  const std::size_t all = pictures();
  EXPECT_GT(all, first);
  EXPECT_TRUE(contains(history({"gc", "--as-of", "2026-11-25", "--dry-run"}).out, "would be removed"));
  EXPECT_EQ(pictures(), all);
  EXPECT_TRUE(exitedWith(0, history({"gc", "--as-of", "2026-11-25"})));
  EXPECT_EQ(pictures(), all) << "each run begins a lane of its own settings: all are first and last ones";
  EXPECT_TRUE(exitedWith(64, history({"gc", "--as-of", "tomorrow"})));
}

// One that differs: tests/job/sentinels_test.cpp.
TEST_F(HistoryCommandTest, SentinelsAreComparedAnewAndEqualOnesChangeNothing) {
  writeScenes(2);
  const std::vector<std::string> cached = {
      "--suite", path("night.toml"), "--size",  "32x32",
      "--cache", path("cache"),      "--as-of", "2026-11-25"}; // the command that compares a row again has it
  const auto run = [&](const std::string& to, const std::vector<std::string>& more = {}) {
    return runParity(join({{"report", "-o", path(to)}, cached, more}));
  };
  ASSERT_TRUE(isReported(run("first")));
  ASSERT_TRUE(isReported(run("second", {"--sentinel"})));
  EXPECT_TRUE(sameFiles(reportIn("second"), reportIn("first")));
  const auto cachedScenes = [&](const std::string& folder) {
    return nlohmann::json::parse(readWholeFile(m_folder / folder / "run.json"))["cachedScenes"].size();
  };
  EXPECT_EQ(cachedScenes("second"), 0u) << "both were compared";
  ASSERT_TRUE(isReported(run("third")));
  EXPECT_EQ(cachedScenes("third"), 2u);
  ASSERT_TRUE(isReported(run("jobs", {"--jobs", "1", "--sentinel"})));
  EXPECT_TRUE(sameFiles(reportIn("jobs"), reportIn("first")));
  EXPECT_TRUE(exitedWith(64, runParity({"report", "builtin:spheres", "--sentinel", "--as-of", "25.11.2026"})));
}

} // namespace
} // namespace parity::tests
