// Verdicts of wholes from their parts, and exit codes.
#include <cmath>

#include <gtest/gtest.h>

#include "compare/budget.h"
#include "compare/sample_report.h"

namespace parity::compare {
namespace {

// One scene, one view, one material of this mean FLIP; pixels = 0: not seen.
Report reportOf(double mean, std::uint64_t pixels = 4000) {
  MaterialResult material = makeMaterial("m", mean, pixels);
  judgeMaterial(material, defaultBudgets(), "s");
  ViewResult view;
  view.name = "v";
  view.width = view.height = 64;
  view.whole = makeRegion("whole", 0.01, 4000);
  view.materials = {material};
  judgeWhole(view, defaultBudgets(), "s");
  Report report;
  report.scenes.emplace_back().name = "s";
  report.scenes[0].views = {view};
  settleVerdicts(report);
  return report;
}

Report withError(Report report, int code) {
  SceneResult& scene = report.scenes.emplace_back();
  scene.name = "broken";
  scene.error = "broken.glb: missing";
  scene.errorExitCode = code;
  settleVerdicts(report);
  return report;
}

TEST(Verdict, TheWorstPartIsTheVerdictOfTheWhole) {
  for (const auto& [mean, verdict] : {std::pair{0.05, Verdict::pass}, {0.15, Verdict::warn}, {0.25, Verdict::fail}}) {
    const Report report = reportOf(mean);
    EXPECT_EQ(report.scenes[0].views[0].materials[0].verdict, verdict);
    EXPECT_EQ(report.scenes[0].views[0].verdict, verdict);
    EXPECT_EQ(report.scenes[0].verdict, verdict);
    EXPECT_EQ(report.verdict, verdict);
  }
  Report report = reportOf(0.05);
  report.scenes.push_back(reportOf(0.25).scenes[0]);
  report.scenes.push_back(reportOf(0.15).scenes[0]);
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, Verdict::fail);
  EXPECT_EQ(report.scenes[0].verdict, Verdict::pass);
  EXPECT_EQ(report.scenes[2].verdict, Verdict::warn);
}

TEST(Verdict, TheWholeImageCountsToo) {
  Report report = reportOf(0.05);
  report.scenes[0].views[0].whole = makeRegion("whole", 0.3, 4000);
  judgeWhole(report.scenes[0].views[0], defaultBudgets(), "s");
  settleVerdicts(report);
  EXPECT_EQ(report.scenes[0].views[0].wholeVerdict, Verdict::fail);
  EXPECT_EQ(report.scenes[0].views[0].materials[0].verdict, Verdict::pass);
  EXPECT_EQ(report.verdict, Verdict::fail);
  EXPECT_FALSE(report.scenes[0].views[0].reason.empty());
}

TEST(Verdict, NothingIsAnErrorNeverAPass) {
  Report empty;
  settleVerdicts(empty);
  EXPECT_EQ(empty.verdict, Verdict::error);

  Report noViews;
  noViews.scenes.emplace_back().name = "s";
  settleVerdicts(noViews);
  EXPECT_EQ(noViews.verdict, Verdict::error);
  EXPECT_FALSE(noViews.scenes[0].error.empty());

  Report noMaterials = reportOf(0.05);
  noMaterials.scenes[0].views[0].materials.clear();
  settleVerdicts(noMaterials);
  EXPECT_EQ(noMaterials.verdict, Verdict::error);

  Report noChecks = reportOf(0.05);
  noChecks.scenes[0].views[0].materials[0].checks.clear();
  settleVerdicts(noChecks);
  EXPECT_EQ(noChecks.verdict, Verdict::error);

  Report noWholeChecks = reportOf(0.05);
  noWholeChecks.scenes[0].views[0].checks.clear();
  settleVerdicts(noWholeChecks);
  EXPECT_EQ(noWholeChecks.verdict, Verdict::error);

  for (const Report* report : {&empty, &noViews, &noMaterials, &noChecks, &noWholeChecks})
    EXPECT_EQ(exitCode(*report, false), 4);
}

TEST(Verdict, AMaterialThatAnotherViewShowsIsNotMissed) {
  Report report = reportOf(0.05, 0);
  EXPECT_EQ(report.verdict, Verdict::notSeen);
  EXPECT_EQ(countVerdicts(report).notSeen, 1u);

  ViewResult other = reportOf(0.05).scenes[0].views[0];
  other.name = "behind";
  report.scenes[0].views.push_back(other);
  settleVerdicts(report);
  const MaterialResult& hidden = report.scenes[0].views[0].materials[0];
  EXPECT_EQ(hidden.verdict, Verdict::notSeen);
  EXPECT_TRUE(hidden.seenElsewhere);
  EXPECT_EQ(hidden.reason, "not seen in this view; view 'behind' shows it");
  EXPECT_EQ(report.verdict, Verdict::pass);
  EXPECT_EQ(countVerdicts(report).notSeen, 0u);
  EXPECT_EQ(countVerdicts(report).total(), 1u);
}

TEST(Verdict, ANamesakeInAnotherPlaceDoesNotMakeAMaterialSeen) {
  Report report = reportOf(0.05, 0);
  ViewResult other = reportOf(0.05).scenes[0].views[0];
  other.materials.insert(other.materials.begin(), other.materials[0]);
  other.materials[0].name = "another";
  report.scenes[0].views.push_back(other);
  settleVerdicts(report);
  EXPECT_FALSE(report.scenes[0].views[0].materials[0].seenElsewhere);
  EXPECT_EQ(report.verdict, Verdict::notSeen);
}

TEST(Verdict, RequireSeenFailsOnlyWhereNoViewShowsIt) {
  Report report = reportOf(0.05, 0);
  report.scenes[0].views[0].materials[0].rule.requireSeen = true;
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, Verdict::fail);
  report.scenes[0].views.push_back(reportOf(0.05).scenes[0].views[0]);
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, Verdict::pass);
}

TEST(Verdict, AViewThatShowsNothingIsNotSeenEvenIfOthersShowAll) {
  Report report = reportOf(0.05);
  ViewResult away = reportOf(0.05, 0).scenes[0].views[0];
  away.whole = makeRegion("whole", 0, 0);
  away.checks.clear();
  report.scenes[0].views.push_back(away);
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, Verdict::notSeen);
}

TEST(Verdict, NonFinitePixelsInTheWholeImageFail) {
  Report report = reportOf(0.05);
  report.scenes[0].views[0].whole.all.nonFinite = 1;
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, Verdict::fail);
}

TEST(Verdict, BothAllBlackIsIdenticalSoItPassesAndSaysSo) {
  Report report = reportOf(0);
  ViewResult& view = report.scenes[0].views[0];
  for (RegionFigures* figures : {&view.whole, &view.materials[0].figures}) {
    *figures = makeRegion("black", 0, 4000);
    for (Figures* part : {&figures->interior, &figures->all}) part->referenceLuma = part->testLuma = 0;
  }
  judgeMaterial(view.materials[0], defaultBudgets(), "s");
  judgeWhole(view, defaultBudgets(), "s");
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, Verdict::pass);
  EXPECT_NE(toTable(report, false).find("identical  both are black"), std::string::npos) << toTable(report, false);
  EXPECT_NE(toJson(report).find("both are black"), std::string::npos);
}

TEST(Verdict, SettlingTwiceChangesNothing) {
  Report report = makeSampleReport();
  const std::string once = toJson(report);
  settleVerdicts(report);
  EXPECT_EQ(toJson(report), once);
}

TEST(ExitCode, FollowsTheVerdict) {
  EXPECT_EQ(exitCode(reportOf(0.05), true), 0);
  EXPECT_EQ(exitCode(reportOf(0.15), false), 0);
  EXPECT_EQ(exitCode(reportOf(0.15), true), 1);
  EXPECT_EQ(exitCode(reportOf(0.25), false), 2);
  EXPECT_EQ(exitCode(reportOf(0.25), true), 2);
}

TEST(ExitCode, NotSeenIsAWarning) {
  EXPECT_EQ(exitCode(reportOf(0, 0), false), 0);
  EXPECT_EQ(exitCode(reportOf(0, 0), true), 1);
}

TEST(ExitCode, TheHighestWins) {
  EXPECT_EQ(exitCode(withError(reportOf(0.25), 3), false), 3);
  EXPECT_EQ(exitCode(withError(reportOf(0.05), 4), false), 4);
  EXPECT_EQ(exitCode(withError(withError(reportOf(0.25), 4), 3), false), 4);
  EXPECT_EQ(exitCode(withError(withError(reportOf(0.25), 3), 4), false), 4);
}

TEST(ExitCode, AnErrorWithAnyOtherCodeIsFour) {
  for (const int code : {0, 1, 2, 64, -1}) EXPECT_EQ(exitCode(withError(reportOf(0.05), code), false), 4) << code;
}

TEST(ExitCode, FiguresThatAreNotNumbersAreFour) {
  Report report = reportOf(0.05);
  setFigure(report.scenes[0].views[0].materials[0].figures.all, "rmse", NAN);
  settleVerdicts(report);
  EXPECT_EQ(exitCode(report, false), 4);
}

TEST(Verdict, CountsEachRowOnce) {
  const VerdictCounts counts = countVerdicts(makeSampleReport());
  EXPECT_EQ(counts.pass, 3u);    // Glass twice, Bulb in front
  EXPECT_EQ(counts.fail, 2u);    // Rough metal in both views
  EXPECT_EQ(counts.warn, 2u);    // Shade in both
  EXPECT_EQ(counts.notSeen, 2u); // Screw in neither; Bulb, not seen from behind, is seen in front
  EXPECT_EQ(counts.error, 0u);
  EXPECT_EQ(counts.total(), 9u);
}

TEST(Verdict, ATruthJudgesNothing) {
  const Report without = makeSampleReport(), with = makeSampleReportWithTruth();
  EXPECT_EQ(with.verdict, without.verdict);
  for (std::size_t i = 0; i < without.scenes[0].views[0].materials.size(); ++i)
    EXPECT_EQ(with.scenes[0].views[0].materials[i].verdict, without.scenes[0].views[0].materials[i].verdict);
  EXPECT_EQ(exitCode(with, false), exitCode(without, false));
}

TEST(Verdict, ATruthThatIsNotFiniteIsAnError) {
  Report report = makeSampleReportWithTruth();
  report.scenes.resize(1);
  ViewResult& view = report.scenes[0].views[0];
  view.truth->all.nonFinite = 3;
  view.materials[0].truth->all.nonFinite = 3; // passed
  view.materials[1].truth->all.nonFinite = 1; // failed
  settleVerdicts(report);
  EXPECT_EQ(view.materials[0].verdict, Verdict::error);
  EXPECT_EQ(view.materials[0].reason, "3 of 90000 pixels of the truth are NaN or infinite");
  EXPECT_EQ(view.materials[1].verdict, Verdict::error);
  EXPECT_EQ(view.materials[1].reason.find("1 of 120000 pixels of the truth are NaN or infinite; mean FLIP 0.270"), 0u)
      << view.materials[1].reason;
  EXPECT_EQ(view.wholeVerdict, Verdict::error);
  EXPECT_EQ(view.reason, "3 of 400000 pixels of the truth are NaN or infinite");
  EXPECT_EQ(exitCode(report, false), 4);
}

} // namespace
} // namespace parity::compare
