// parity approve, --approvals, --as-of, --summary and --fail-on, end to end.
#include <algorithm>

#include "cli/checks.h"

namespace parity::tests {
namespace {

class ApprovalsTest : public RenderingTest {
protected:
  // A scene that is over its budget everywhere.
  std::vector<std::string> options() const {
    return join({{"builtin:spheres", "--budgets", writeBudgets(m_folder, "fail = 0.0001")}, kSun, kSmall});
  }
  RunResult report(const std::string& to, const std::vector<std::string>& more = {}, const RunOptions& run = {}) const {
    return runParity(join({{"report", "-o", path(to)}, options(), more}), run);
  }
  RunResult approve(const std::vector<std::string>& more, const std::string& until = "2999-01-01") const {
    return runParity(join({{"approve", path("out"), "--reason", "known", "--owner", "characters", "--until", until,
                            "-o", path("approvals.toml")},
                           more}));
  }
  // The first material of which something is accepted. It may still warn, as small pictures are clipped.
  nlohmann::json acceptedRow(const std::string& folder) const {
    const nlohmann::json report = readReport(m_folder / folder);
    for (const nlohmann::json& row : report["scenes"][0]["views"][0]["materials"])
      if (row.contains("accepted")) return row;
    return nullptr;
  }
  // Of a command line that means nothing.
  static void expectUsage(const RunResult& result, const std::vector<std::string>& parts) {
    EXPECT_TRUE(exitedWith(64, result));
    for (const std::string& part : parts) EXPECT_TRUE(contains(result.err, part)) << result.err;
  }
  const std::vector<std::string> kAll = {"--material", "*", "--whole", "--yes"};
};

TEST_F(ApprovalsTest, WhatIsApprovedPassesUntilItsDay) {
  ASSERT_TRUE(exitedWith(2, report("out")));
  const RunResult approved = approve(kAll);
  ASSERT_TRUE(exitedWith(0, approved));
  EXPECT_TRUE(contains(approved.out, "entries added, 0 replaced")) << approved.out;

  const std::vector<std::string> judged = {"--approvals", path("approvals.toml"), "--as-of", "2998-06-01"};
  const RunResult passed = report("passed", judged);
  EXPECT_TRUE(exitedWith(0, passed));
  EXPECT_TRUE(contains(passed.out, "pass by accepted exceptions")) << passed.out;
  const nlohmann::json row = acceptedRow("passed");
  ASSERT_FALSE(row.is_null());
  EXPECT_NE(row["verdict"], "fail");
  EXPECT_TRUE(contains(row["accepted"], "approved until 2999-01-01 by characters: known (approvals.toml, line"));
  EXPECT_EQ(row["checks"][0]["approval"]["state"], "holds");
  EXPECT_EQ(readReport(m_folder / "passed")["approvals"]["asOf"], "2998-06-01");
  EXPECT_TRUE(contains(readWholeFile(m_folder / "passed" / "junit.xml"), "approved until 2999-01-01"));

  // The same bytes by workers, and by plan and merge, which may be given the file anew.
  EXPECT_TRUE(exitedWith(0, report("workers", join({judged, {"--jobs", "2"}}))));
  EXPECT_EQ(readWholeFile(m_folder / "workers" / "report.json"), readWholeFile(m_folder / "passed" / "report.json"));
  ASSERT_TRUE(exitedWith(0, runParity(join({{"plan", "-o", path("night")}, options(), judged}))));
  const std::string approvals = readWholeFile(m_folder / "approvals.toml");
  std::filesystem::remove(m_folder / "approvals.toml");
  ASSERT_TRUE(exitedWith(0, runParity({"work", path("night")})));
  EXPECT_TRUE(exitedWith(0, runParity({"merge", path("night"), "-o", path("merged")}))) << "of the plan's copy";
  EXPECT_EQ(readWholeFile(m_folder / "merged" / "report.json"), readWholeFile(m_folder / "passed" / "report.json"));
  write("approvals.toml", approvals);
  const RunResult late = runParity(
      {"merge", path("night"), "-o", path("late"), "--approvals", path("approvals.toml"), "--as-of", "2999-01-09"});
  EXPECT_TRUE(exitedWith(2, late));
  EXPECT_TRUE(contains(late.out, "does not hold: it expired on 2999-01-01")) << late.out;
  EXPECT_TRUE(
      exitedWith(1, runParity({"merge", path("night"), "-o", path("late"), "--as-of", "2999-01-08", "--warn-exit"})));
}

TEST_F(ApprovalsTest, FileIsSortedAndEntriesAreReplaced) {
  ASSERT_TRUE(exitedWith(2, report("out")));
  write("approvals.toml", "# Ask the team before you add a line.\n");
  ASSERT_TRUE(exitedWith(0, approve(kAll)));
  const std::string first = readWholeFile(m_folder / "approvals.toml");
  EXPECT_TRUE(first.starts_with("# Ask the team before you add a line.\nnumerics = \"")) << first;
  const RunResult again = approve(join({kAll, {"--slack", "5%"}}));
  EXPECT_TRUE(contains(again.out, ": 0 entries added, ")) << again.out;
  EXPECT_NE(readWholeFile(m_folder / "approvals.toml"), first);
  ASSERT_TRUE(exitedWith(0, approve(kAll)));
  EXPECT_EQ(readWholeFile(m_folder / "approvals.toml"), first);
}

TEST_F(ApprovalsTest, WhatCannotBeApprovedIsRefused) {
  ASSERT_TRUE(exitedWith(2, report("out")));
  expectUsage(approve({}), {"--material or --whole"});
  expectUsage(approve(kAll, "2020-01-01"), {"--until", "2020-01-01 is past"});
  expectUsage(approve(kAll, "2999-02-30"), {"--until", "is not a day"});
  expectRefused(approve({"--material", "No such*"}), 4, {"nothing to approve"});
  expectUsage(approve({"--material", "*", "--metric", "flop"}), {"--metric", "flip"});
  write("approvals.toml", "numerics = \"" + std::string(32, '0') + "\"\n");
  expectRefused(approve(kAll), 4, {"approvals.toml: numerics", "round otherwise"});
  write("approvals.toml", "<<<<<<< HEAD\n");
  expectRefused(approve(kAll), 4, {"approvals.toml: line 1", "merge conflict marker"});
  std::filesystem::remove(m_folder / "approvals.toml");

  for (const std::vector<std::string>& part : {std::vector<std::string>{"--material", "*"}, {"--only", "spheres"}}) {
    ASSERT_TRUE(isReported(report("out", part)));
    expectRefused(approve(kAll), 4, {"nothing of it is approved: it shows a part of the"});
  }
  ASSERT_TRUE(exitedWith(4, report("out", {path("no.glb")})));
  expectRefused(approve(kAll), 4, {"1 of 2 scenes has no result"});
  std::filesystem::remove(m_folder / "out" / "run.json");
  ASSERT_FALSE(std::filesystem::exists(m_folder / "approvals.toml"));
  expectRefused(runParity({"approve", path("out/report.json"), "--material", "*", "--reason", "r", "--owner", "o",
                           "--until", "2999-01-01"}),
                4, {"is not the folder of a report"});
}

TEST_F(ApprovalsTest, BadFileIsRefusedBeforeAnythingIsRendered) {
  write("approvals.toml", "[[accept]]\nscene = 3\n");
  const std::vector<std::string> judged = {"--approvals", path("approvals.toml")};
  expectRefused(report("out", judged), 4, {"approvals.toml: line 2", "'scene' must be a string"});
  expectRefused(runParity(join({{"plan", "-o", path("night")}, options(), judged})), 4, {"approvals.toml: line 2"});
  expectRefused(report("out", {"--approvals", path("none.toml")}), 4, {"none.toml"});
  expectUsage(report("out", {"--as-of", "tomorrow"}), {"--as-of", "'tomorrow' is not a day"});
  expectRefused(report("out", join({{"--summary", path("approvals.toml")}, judged})), 64,
                {"would overwrite the approvals"});
}

TEST_F(ApprovalsTest, SummaryGoesToItsFileAndToTheStepsOwn) {
  RunOptions run;
  run.environment.emplace_back("GITHUB_STEP_SUMMARY", path("step.md"));
  write("step.md", "before\n");
  ASSERT_TRUE(exitedWith(2, report("out", {"--summary", path("summary.md")}, run)));
  const std::string summary = readWholeFile(m_folder / "summary.md");
  EXPECT_TRUE(summary.starts_with("## parity: fail\n")) << summary;
  EXPECT_TRUE(contains(summary, "### Failures (")) << summary;
  EXPECT_EQ(readWholeFile(m_folder / "step.md"), "before\n" + summary + "\n");

  ASSERT_TRUE(exitedWith(2, report("out", {"--summary", path("slack.json"), "--summary-format", "slack"}, run)));
  EXPECT_TRUE(nlohmann::json::parse(readWholeFile(m_folder / "slack.json"))["blocks"].is_array());
  EXPECT_EQ(readWholeFile(m_folder / "step.md"), "before\n" + summary + "\n") << "not of another format";
  ASSERT_TRUE(exitedWith(2, report("out", {}, run)));
  EXPECT_EQ(readWholeFile(m_folder / "step.md"), "before\n" + summary + "\n") << "not unless it is asked for";
  expectUsage(report("out", {"--summary", path("s.md"), "--pictures-url", "javascript:x"}), {"--pictures-url"});
  expectUsage(report("out", {"--summary-format", "slack"}), {"--summary"});
}

TEST_F(ApprovalsTest, SummaryOfADiff) {
  const std::string url = "https://example.com/out";
  const RunResult result = runParity({"diff", "builtin:spheres", "--sun", "30,50,4", "--size", "64x64", "--summary",
                                      path("diff.json"), "--summary-format", "slack", "--pictures-url", url});
  EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
  EXPECT_TRUE(nlohmann::json::parse(readWholeFile(m_folder / "diff.json"))["blocks"].is_array());
  expectUsage(runParity({"diff", "builtin:spheres", "--summary", path("s.md"), "--pictures-url", "javascript:x"}),
              {"--pictures-url"});
}

TEST_F(ApprovalsTest, FailOnNewCountsOnlyWhatTheBaselineDoesNotHave) {
  ASSERT_TRUE(exitedWith(2, report("old")));
  const RunResult same = report("out", {"--baseline", path("old"), "--fail-on", "new"});
  EXPECT_TRUE(exitedWith(0, same));
  EXPECT_TRUE(contains(same.out, "0 new failures, ")) << same.out;
  EXPECT_TRUE(contains(same.out, "still failing, not counted")) << same.out;
  expectUsage(report("out", {"--fail-on", "new"}), {"--fail-on", "needs --history or --baseline"});
  ASSERT_TRUE(isReported(report("part", {"--material", "*"})));
  const RunResult part = report("out", {"--baseline", path("part"), "--fail-on", "new"});
  EXPECT_TRUE(exitedWith(4, part));
  EXPECT_TRUE(contains(part.err, "the baseline is not complete: it shows a part of the materials")) << part.err;
  ASSERT_TRUE(exitedWith(0, runParity(join({{"plan", "-o", path("night")}, options()}))));
  expectRefused(runParity({"merge", path("night"), "-o", path("m"), "--fail-on", "new"}), 64,
                {"--fail-on", "--baseline"});
}

} // namespace
} // namespace parity::tests
