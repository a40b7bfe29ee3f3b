// Entries made of a report: what is approved is covered afterwards, and what nobody may approve is refused.
#include <cmath>

#include <gtest/gtest.h>

#include "base/file.h"
#include "base/temp_folder.h"
#include "report/approvals.h"
#include "report/judge.h"
#include "report/reader.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

const base::Day kUntil = *base::dayFrom("2999-01-01");

// With metals over budget, one of them by two figures, a material that warns, and one that is well.
Report makeOverBudget() {
  Report report;
  report.conditions = {{"materials", "all", compare::ActsOn::wholes}};
  SceneResult& scene = report.scenes.emplace_back();
  scene.name = "Hero";
  scene.inputs = SceneInputs{"aa", "bb", "cc", ""};
  ViewResult& view = scene.views.emplace_back();
  view.name = "front";
  view.whole = makeFigures(0.3, 9000);
  view.materials = {makeMaterial("metal 1", 0.21234567, 4000), makeMaterial("metal 2", 0.3, 4000),
                    makeMaterial("wood", 0.11, 4000), makeMaterial("well", 0.01, 4000)};
  return report;
}

// Judged, with the change, written and read back with its checks.
Report readBack(Report report) {
  for (SceneResult& scene : report.scenes) judgeScene(scene, compare::defaultBudgets());
  settleVerdicts(report);
  const base::TempFolder folder;
  base::writeText(folder / "report.json", toJson(report));
  return readReport(folder.path(), ReadDepth::checks);
}

ApproveRequest makeRequest(const std::string& material = "*") {
  ApproveRequest request;
  request.materials = {material};
  request.owner = "characters", request.reason = "known", request.until = kUntil;
  return request;
}

std::string figuresOf(const ApproveResult& result) {
  std::string text;
  for (const compare::Approval& entry : result.entries)
    text += (text.empty() ? "" : ", ") + (entry.material.empty() ? "whole" : entry.material) + " " + entry.metric;
  return text;
}

TEST(Approve, TakesTheFiguresBeyondALimitOfRowsThatFail) {
  const Report report = readBack(makeOverBudget());
  EXPECT_EQ(figuresOf(approveRows(report, makeRequest())),
            "metal 1 flip.mean, metal 1 flip.p95, metal 2 flip.mean, metal 2 flip.p95");
  EXPECT_EQ(figuresOf(approveRows(report, makeRequest("*1"))), "metal 1 flip.mean, metal 1 flip.p95");
  ApproveRequest request = makeRequest("metal 2");
  request.metrics = {"flip.mean"};
  EXPECT_EQ(figuresOf(approveRows(report, request)), "metal 2 flip.mean");
  request.scenes = {"Other"};
  EXPECT_EQ(figuresOf(approveRows(report, request)), "");
  request = makeRequest("wood");
  EXPECT_EQ(figuresOf(approveRows(report, request)), "");
  request.warnings = true;
  EXPECT_EQ(figuresOf(approveRows(report, request)), "wood flip.mean");
  request = makeRequest();
  request.materials.clear(), request.wholes = true;
  EXPECT_EQ(figuresOf(approveRows(report, request)), "whole flip.mean, whole flip.p95");
}

TEST(Approve, WhatIsApprovedIsCovered) {
  ApproveRequest request = makeRequest();
  request.wholes = request.warnings = true;
  for (const double slack : {0.01, 0.0}) {
    request.slack = slack;
    Report report = makeOverBudget();
    compare::Approvals approvals{.file = "a.toml", .head = {}, .numerics = {}, .entries = {}};
    mergeApprovals(approvals, approveRows(readBack(report), request).entries);
    approvals = compare::readApprovals(compare::formatApprovals(approvals), "a.toml");
    EXPECT_EQ(approvals.entries[2].value, 0.2123) << "four digits";
    for (SceneResult& scene : report.scenes) judgeScene(scene, compare::defaultBudgets());
    applyApprovals(report, approvals, *base::dayFrom("2027-01-01"), EntriesFor::all);
    settleVerdicts(report);
    EXPECT_EQ(exitCode(report, true), 0) << slack;
  }
}

TEST(Approve, NothingIsMadeForWhatNobodyMayApprove) {
  const auto refusalOf = [](auto change) {
    Report report = makeOverBudget();
    change(report.scenes[0], report.scenes[0].views[0].materials[0]);
    const ApproveResult result = approveRows(readBack(report), makeRequest("metal 1"));
    EXPECT_TRUE(result.entries.empty()) << figuresOf(result);
    return result.refused.empty() ? std::string() : result.refused[0];
  };
  EXPECT_EQ(refusalOf([](SceneResult&, MaterialResult& m) { m.figures.nonFinite = 2; }),
            "'metal 1' (Hero, view front): NaN and infinite pixels are never approved");
  EXPECT_NE(refusalOf([](SceneResult&, MaterialResult& m) { setFigure(m.figures, "flip.mean", NAN); }).find("no error"),
            std::string::npos);
  EXPECT_NE(refusalOf([](SceneResult&, MaterialResult& m) {
              setFigure(m.figures, "flip.mean", 1);
              setFigure(m.figures, "flip.p95", 1);
            }).find("would accept whatever comes"),
            std::string::npos);
  EXPECT_NE(refusalOf([](SceneResult& s, MaterialResult&) { s.inputs.reset(); }).find("digests of its inputs"),
            std::string::npos);
  EXPECT_EQ(refusalOf([](SceneResult&, MaterialResult& m) { m.figures = {}; }), "") << "not seen: no failure";
}

TEST(Approve, EntryOfTheSameFigureIsReplacedAndOthersStay) {
  compare::Approvals approvals;
  approvals.entries = approveRows(readBack(makeOverBudget()), makeRequest("metal 1")).entries;
  approvals.entries[0].owner = "somebody";
  approvals.entries[1].scene = "Other";
  const MergedApprovals merged =
      mergeApprovals(approvals, approveRows(readBack(makeOverBudget()), makeRequest("metal 1")).entries);
  EXPECT_EQ(merged.replaced, 1u);
  EXPECT_EQ(merged.added, 1u);
  ASSERT_EQ(approvals.entries.size(), 3u);
  EXPECT_EQ(approvals.entries[0].owner, "characters");
  EXPECT_EQ(approvals.entries[1].scene, "Other");
}

TEST(Approve, ReportIsWholeOrItSaysWhyNot) {
  Report report = makeOverBudget();
  EXPECT_EQ(whyNotWhole(report), "");
  report.conditions[0].value = "metal*";
  EXPECT_EQ(whyNotWhole(report), "it shows a part of the materials (--material)");
  report.only = {"Hero/front"};
  EXPECT_EQ(whyNotWhole(report), "it shows a part of the views (--only)");
  report = makeOverBudget();
  report.scenes.emplace_back().name = "Lost";
  report.scenes[1].error = "has no result: shard 3 did not finish it";
  EXPECT_EQ(whyNotWhole(report), "1 of 2 scenes has no result: 'Lost': has no result: shard 3 did not finish it");
  EXPECT_EQ(whyNotWhole(Report()), "it has no scene");
}

TEST(Approve, ChecksAreReadOnlyWhereTheyAreAskedFor) {
  Report report = makeOverBudget();
  judgeScene(report.scenes[0], compare::defaultBudgets());
  settleVerdicts(report);
  const base::TempFolder folder;
  base::writeText(folder / "report.json", toJson(report));
  RunInfo run;
  run.startedAt = "2026-11-25T03:00:12Z";
  run.origin.numerics = std::string(32, 'a');
  base::writeText(folder / "run.json", toJson(run));
  EXPECT_TRUE(readReport(folder.path()).scenes[0].views[0].materials[0].checks.empty());
  const Report read = readReport(folder.path(), ReadDepth::checks);
  ASSERT_FALSE(read.scenes[0].views[0].checks.empty());
  EXPECT_EQ(read.scenes[0].views[0].checks[0].metric, "flip.mean");
  EXPECT_EQ(read.scenes[0].views[0].checks[0].verdict, compare::Verdict::fail);
  EXPECT_EQ(readRun(folder.path()).origin.numerics, run.origin.numerics);
}

} // namespace
} // namespace parity::report
