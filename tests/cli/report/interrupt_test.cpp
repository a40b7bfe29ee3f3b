// SIGINT and SIGTERM: a report of what is finished, and a second signal that ends the program at once.
#include "cli/checks.h"

namespace parity::tests {
namespace {

// A run that a signal reaches while its first scene is integrated by the truth, which takes long.
class InterruptTest : public RenderingTest {
protected:
  RunResult reportSlowly(const RunOptions& options, const std::vector<std::string>& more = {}) const {
    return runParity(join({{"report", "builtin:spheres", "builtin:furnace", "builtin:lights", "-o", path("out"),
                            "--truth", "--error", "0.01%", "--threads", "1", "--no-cache"},
                           {"--size", "128x128", "--env", "builtin:studio"},
                           kRoughSky,
                           more}),
                     options);
  }
  static RunOptions at(const std::string& text, int signal) {
    RunOptions options;
    options.terminal = true; // where progress is shown
    options.interruptAt = text;
    options.interruptBy = signal;
    return options;
  }
};

TEST_F(InterruptTest, WritesAWholeReportWhoseOtherScenesAreNotRun) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string name = signal == SIGINT ? "SIGINT" : "SIGTERM";
    const RunResult result = reportSlowly(at("truth", signal));
    EXPECT_TRUE(exitedWith(128 + signal, result));
    EXPECT_TRUE(contains(result.err, "interrupted: the report is written with what is finished")) << result.err;
    EXPECT_TRUE(contains(result.err, "error: not run: 3 of 3 scenes (" + name + " interrupted the run): "))
        << result.err;
    EXPECT_TRUE(contains(result.out, "not run: 3 of 3 scenes")) << result.out;
    EXPECT_TRUE(contains(result.out, "verdict: not run")) << result.out;
    const nlohmann::json report = readReport(m_folder / "out");
    EXPECT_EQ(report["verdict"], "not run");
    EXPECT_EQ(report["headline"], "Interrupted: 3 of 3 scenes were not run");
    ASSERT_EQ(report["scenes"].size(), 3u);
    for (const nlohmann::json& scene : report["scenes"]) {
      EXPECT_EQ(scene["verdict"], "not run");
      EXPECT_EQ(scene["error"]["exitCode"], 128 + signal);
      EXPECT_TRUE(scene["views"].empty());
    }
    EXPECT_EQ(listFiles(m_folder / "out"), reportFiles(3)) << "no pictures that the report does not name";
    EXPECT_TRUE(contains(readWholeFile(m_folder / "out" / "junit.xml"), "<skipped message=\"not run: "));
  }
}

TEST_F(InterruptTest, WhatIsFinishedStays) {
  const std::string suite = write("s.toml", R"(
[[scene]]
file = "builtin:furnace"
[[scene]]
file = "builtin:spheres"
environment = "builtin:studio"
[[scene]]
file = "builtin:lights"
)");
  // The first scene, which has no light but white, is done first; the signal comes as the second one begins.
  const std::vector<std::string> command = join({{"report", "--suite", suite, "-o", path("out"), "--truth", "--error",
                                                  "1%", "--threads", "1", "--size", "64x64", "--no-cache"},
                                                 kRoughSky});
  const RunResult result = runParity(command, at("1 of 3 done, spheres", SIGINT));
  EXPECT_TRUE(exitedWith(130, result));
  const nlohmann::json report = readReport(m_folder / "out");
  EXPECT_TRUE(report["scenes"][0]["error"].is_null());
  EXPECT_NE(report["scenes"][0]["verdict"], "not run");
  EXPECT_EQ(report["scenes"][0]["views"].size(), 1u);
  EXPECT_EQ(report["scenes"][1]["verdict"], "not run");
  EXPECT_EQ(report["scenes"][2]["verdict"], "not run");
  const std::vector<std::string> files = listFiles(m_folder / "out");
  for (const std::string& file : join({listPictures(report), listPixelFiles(report), reportFiles(3)}))
    EXPECT_EQ(std::ranges::count(files, file), 1) << file;
  for (const std::string& file : files)
    EXPECT_FALSE(contains(file, "1-spheres") || contains(file, "2-lights")) << "of a scene that was given up: " << file;
}

TEST_F(InterruptTest, ASecondSignalEndsTheProgramAtOnce) {
  RunOptions options = at("truth", SIGINT);
  options.signals = 2; // the second one before anything can be written
  const RunResult result = reportSlowly(options);
  EXPECT_EQ(result.signal, SIGINT) << result.err;
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out" / "report.json"));
}

TEST_F(InterruptTest, ABaselineDoesNotCallWhatWasNotRunGone) {
  ASSERT_TRUE(
      isReported(runParity(join({{"report", "builtin:spheres", "builtin:furnace", "-o", path("old")}, kSmall}))));
  const RunResult result = reportSlowly(at("truth", SIGINT), {"--baseline", path("old")});
  EXPECT_TRUE(exitedWith(130, result));
  EXPECT_TRUE(readReport(m_folder / "out")["baseline"]["gone"].empty());
  EXPECT_EQ(readReport(m_folder / "out")["baseline"]["error"], "");
}

} // namespace
} // namespace parity::tests
