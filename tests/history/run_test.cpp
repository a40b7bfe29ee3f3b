// What history keeps of a report.
#include "history/run.h"

#include <cmath>

#include <gtest/gtest.h>

namespace parity::tests {
namespace {

TEST(RoundedFigure, HasFourSignificantDigits) {
  EXPECT_EQ(history::roundedFigure(0.123456), 0.1235);
  EXPECT_EQ(history::roundedFigure(-98765.4), -98770);
  EXPECT_EQ(history::roundedFigure(1e-9 / 3), 3.333e-10);
  EXPECT_EQ(history::roundedFigure(0), 0);
  EXPECT_EQ(history::roundedFigure(INFINITY), INFINITY);
  EXPECT_TRUE(std::isnan(history::roundedFigure(NAN)));
}

TEST(MakeRecord, TakesFiguresInputsTimesAndCrashes) {
  report::Report report;
  report.suite = "nightly", report.device = "llvmpipe", report.digests = {"settings", "budgets"};
  report::SceneResult& scene = report.scenes.emplace_back();
  scene.name = "Hero", scene.inputs = {"asset", "environment", "request", ""};
  report::ViewResult& view = scene.views.emplace_back();
  view.name = "front";
  view.whole.pixels = 10, view.whole.values = {{"flip.mean", 0.111119}};
  report::MaterialResult& material = view.materials.emplace_back();
  material.name = "Chrome", material.verdict = compare::Verdict::fail, material.reason = "too much";
  material.rule.origin = "budgets.toml, line 3";
  material.figures.pixels = 5, material.figures.values = {{"flip.mean", 0.222229}};
  view.materials.emplace_back().name = "Hidden"; // no pixel
  report::RunInfo run;
  run.startedAt = "2026-11-25T03:00:12Z";
  run.cachedScenes = {"Hero"}, run.sceneTimes = {{"Hero", 2, 5, "another processor"}};
  run.origin = {.build = "build", .driver = "Mesa", .numerics = "numerics", .machine = "processor", .isWhole = false};
  const history::RunRecord record = history::makeRecord(report, run, {"main", "abc", "2026-11-24T00:00:00Z"});
  EXPECT_EQ(record.started, run.startedAt);
  EXPECT_EQ(record.branch, "main");
  EXPECT_EQ(record.settings, "settings");
  EXPECT_EQ(record.build, "build");
  EXPECT_FALSE(record.isWhole);
  ASSERT_EQ(record.scenes.size(), 1u);
  EXPECT_EQ(record.scenes[0].inputs.request, "request");
  EXPECT_TRUE(record.scenes[0].isCached);
  EXPECT_EQ(record.scenes[0].cpuS, 5);
  EXPECT_EQ(record.scenes[0].machine, "another processor");
  const history::ViewRecord& kept = record.scenes[0].views.at(0);
  EXPECT_EQ(kept.whole.figures.at(0).value, 0.1111);
  EXPECT_EQ(kept.materials.at(0).figures.at(0).value, 0.2222);
  EXPECT_EQ(kept.materials.at(0).rule, "budgets.toml, line 3");
  EXPECT_TRUE(kept.materials.at(1).figures.empty());
}

} // namespace
} // namespace parity::tests
