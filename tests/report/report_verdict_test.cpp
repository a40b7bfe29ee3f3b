// Verdicts of wholes from their parts, and exit codes.
#include <cmath>
#include <csignal>

#include <gtest/gtest.h>

#include "compare/verdict/budget.h"
#include "compare/verdict/wording.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

// One scene, one view, one material of this mean FLIP; pixels = 0: not seen. gain: of its light.
Report reportOf(double mean, std::uint64_t pixels = 4000, double gain = 0.95) {
  MaterialResult material = makeMaterial("m", mean, pixels, gain);
  judgeMaterial(material, compare::defaultBudgets(), "s");
  ViewResult view;
  view.name = "v";
  view.width = view.height = 64;
  view.whole = makeFigures(0.01, 4000);
  view.materials = {material};
  judgeWhole(view, compare::defaultBudgets(), "s");
  Report report;
  report.scenes.emplace_back().name = "s";
  report.scenes[0].views = {view};
  settleVerdicts(report);
  return report;
}

MaterialResult& materialOf(Report& report) { return report.scenes[0].views[0].materials[0]; }

// The same with so much of the material clipped.
Report withClipping(Report report, double black, double white) {
  materialOf(report).figures.clippedBlack = black;
  materialOf(report).figures.clippedWhite = white;
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

// Beside a scene that is well: then a run in which nothing else was compared is one.
Report besidesAPass(Report report) {
  report.scenes.push_back(reportOf(0.05).scenes[0]);
  report.scenes.back().name = "well";
  settleVerdicts(report);
  return report;
}

TEST(Verdict, ARunThatComparedNoMaterialIsAnErrorWithTheReason) {
  const Report notSeen = reportOf(0.05, 0), tooSmall = reportOf(0.05, 12),
               notJudged = withClipping(reportOf(0.05), 0, 0.9);
  for (const auto& [report, reason] :
       {std::pair{notSeen, "1 not seen"}, {tooSmall, "1 too small"}, {notJudged, "1 not judged"}}) {
    EXPECT_EQ(report.verdict, compare::Verdict::error) << reason;
    EXPECT_EQ(exitCode(report, false), 4) << reason;
    ASSERT_EQ(problemsOf(report).size(), 1u) << reason;
    EXPECT_EQ(problemsOf(report)[0].reason, std::string("no material was compared: ") + reason);
    EXPECT_NE(toTable(report, {}, {.all = true}).find(reason), std::string::npos);
    EXPECT_NE(toJunit(report, {}).find("<error type=\"error\" message=\"no material was compared: "),
              std::string::npos);
    EXPECT_NE(toGithubAnnotations(report, "/").find("::error title=parity::no material"), std::string::npos);
    EXPECT_EQ(headline(report), "Nothing was compared");
    const Report other = besidesAPass(report);
    EXPECT_TRUE(problemsOf(other).empty()) << reason;
    EXPECT_EQ(exitCode(other, false), 0) << reason;
    EXPECT_EQ(exitCode(other, true), 1) << reason;
  }
  Report both = notSeen;
  both.scenes.push_back(tooSmall.scenes[0]);
  settleVerdicts(both);
  EXPECT_EQ(problemsOf(both)[0].reason, "no material was compared: 1 not seen, 1 too small");
  EXPECT_TRUE(problemsOf(withError(notSeen, 3)).empty()) << "that has a reason and an exit code of its own";
  EXPECT_EQ(exitCode(withError(notSeen, 3), false), 3);
  EXPECT_TRUE(problemsOf(reportOf(0.25)).empty()) << "what failed was compared";
}

TEST(Verdict, ASceneThatWasNotRunIsNoPassAndHasTheSignalsExitCode) {
  Report report = reportOf(0.05);
  SceneResult& scene = report.scenes.emplace_back();
  scene.name = "Desk";
  setNotRun(scene, SIGTERM);
  settleVerdicts(report);
  settleVerdicts(report); // idempotent
  EXPECT_EQ(report.scenes[1].verdict, compare::Verdict::notRun);
  EXPECT_EQ(report.verdict, compare::Verdict::notRun);
  EXPECT_EQ(exitCode(report, false), 143);
  EXPECT_EQ(headline(report), "Interrupted: 1 of 2 scenes were not run");
  EXPECT_EQ(exitCode(withError(report, 3), false), 143) << "the highest";
  EXPECT_EQ(withError(report, 3).verdict, compare::Verdict::error);
  EXPECT_EQ(headline(withError(report, 3)), "1 scene could not be compared; 1 scene not run");
  EXPECT_NE(toJunit(report, {})
                .find("<skipped message=\"not run: SIGTERM interrupted the run before this scene was "
                      "done\"/>"),
            std::string::npos);
  EXPECT_NE(toGithubAnnotations(report, "/").find("not run: 1 of 2 scenes (SIGTERM interrupted the run): Desk"),
            std::string::npos)
      << toGithubAnnotations(report, "/");
  Report failed = reportOf(0.25);
  setNotRun(failed.scenes.emplace_back(), SIGINT);
  settleVerdicts(failed);
  EXPECT_EQ(failed.verdict, compare::Verdict::notRun);
  EXPECT_EQ(exitCode(failed, false), 130);
  EXPECT_EQ(headline(failed), "Interrupted: 1 of 2 scenes were not run; 1 of 1 materials over budget");
}

TEST(Verdict, AGlobThatMatchesInNoSceneIsAnErrorOfTheRun) {
  Report report = reportOf(0.05);
  report.lost = {{compare::Verdict::error, "--material 'gild': no scene has a material of this name", "", 0}};
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::error);
  EXPECT_EQ(exitCode(report, false), 4);
  EXPECT_EQ(headline(report), "A material that was asked for is in no scene");
  report.scenes.clear();
  settleVerdicts(report);
  EXPECT_EQ(headline(report), "Nothing was compared");
}

TEST(Verdict, AWarningOfTheRunIsAWarning) {
  Report report = reportOf(0.05);
  report.warnings = {"b.toml: a rule judges nothing"};
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::warn);
  EXPECT_EQ(headline(report), "Within budget, with 1 warning about the run");
  EXPECT_EQ(exitCode(report, false), 0);
  EXPECT_EQ(exitCode(report, true), 1);
  EXPECT_NE(toJunit(report, {}).find("<system-out>warning: b.toml: a rule judges nothing"), std::string::npos);
}

TEST(Verdict, WhatIsLostFails) {
  Report report = reportOf(0.05);
  report.lost = {{compare::Verdict::fail, "no scene has 'Hero'", "b.toml", 3}};
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
  EXPECT_EQ(headline(report), "1 material is missing that a budget requires");
  EXPECT_EQ(exitCode(report, false), 2);
  EXPECT_NE(toJunit(report, {}).find("<failure type=\"budget\" message=\"no scene has &#39;Hero&#39;\""),
            std::string::npos);
  EXPECT_NE(toGithubAnnotations(report, "/").find("::error file=b.toml,line=3,title=parity::no scene has 'Hero'"),
            std::string::npos);
  EXPECT_NE(toTable(report, {}, {.all = true}).find("fail: no scene has 'Hero'"), std::string::npos);
}

TEST(Verdict, TheWorstPartIsTheVerdictOfTheWhole) {
  for (const auto& [mean, verdict] :
       {std::pair{0.05, compare::Verdict::pass}, {0.15, compare::Verdict::warn}, {0.25, compare::Verdict::fail}}) {
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
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
  EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::pass);
  EXPECT_EQ(report.scenes[2].verdict, compare::Verdict::warn);
}

TEST(Verdict, TheWholeImageCountsToo) {
  Report report = reportOf(0.05);
  report.scenes[0].views[0].whole = makeFigures(0.3, 4000);
  judgeWhole(report.scenes[0].views[0], compare::defaultBudgets(), "s");
  settleVerdicts(report);
  EXPECT_EQ(report.scenes[0].views[0].wholeVerdict, compare::Verdict::fail);
  EXPECT_EQ(report.scenes[0].views[0].materials[0].verdict, compare::Verdict::pass);
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
  EXPECT_FALSE(report.scenes[0].views[0].reason.empty());
}

TEST(Verdict, NothingIsAnErrorNeverAPass) {
  Report empty;
  settleVerdicts(empty);
  EXPECT_EQ(empty.verdict, compare::Verdict::error);

  Report noViews;
  noViews.scenes.emplace_back().name = "s";
  settleVerdicts(noViews);
  EXPECT_EQ(noViews.verdict, compare::Verdict::error);
  EXPECT_FALSE(noViews.scenes[0].error.empty());

  Report noMaterials = reportOf(0.05);
  noMaterials.scenes[0].views[0].materials.clear();
  settleVerdicts(noMaterials);
  EXPECT_EQ(noMaterials.verdict, compare::Verdict::error);

  Report noChecks = reportOf(0.05);
  noChecks.scenes[0].views[0].materials[0].checks.clear();
  settleVerdicts(noChecks);
  EXPECT_EQ(noChecks.verdict, compare::Verdict::error);

  Report noWholeChecks = reportOf(0.05);
  noWholeChecks.scenes[0].views[0].checks.clear();
  settleVerdicts(noWholeChecks);
  EXPECT_EQ(noWholeChecks.verdict, compare::Verdict::error);

  for (const Report* report : {&empty, &noViews, &noMaterials, &noChecks, &noWholeChecks})
    EXPECT_EQ(exitCode(*report, false), 4);
}

TEST(Verdict, AMaterialThatAnotherViewShowsIsNotMissed) {
  Report report = reportOf(0.05, 0);
  EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::notSeen);
  EXPECT_EQ(countVerdicts(report).notSeen, 1u);

  ViewResult other = reportOf(0.05).scenes[0].views[0];
  other.name = "behind";
  report.scenes[0].views.push_back(other);
  settleVerdicts(report);
  const MaterialResult& hidden = report.scenes[0].views[0].materials[0];
  EXPECT_EQ(hidden.verdict, compare::Verdict::notSeen);
  EXPECT_TRUE(hidden.seenElsewhere);
  EXPECT_EQ(hidden.reason, "not seen in this view; view 'behind' shows it");
  EXPECT_EQ(report.verdict, compare::Verdict::pass);
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
  EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::notSeen);
}

TEST(Verdict, RequireSeenFailsOnlyWhereNoViewShowsIt) {
  Report report = reportOf(0.05, 0);
  report.scenes[0].views[0].materials[0].rule.requireSeen = true;
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
  report.scenes[0].views.push_back(reportOf(0.05).scenes[0].views[0]);
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::pass);
}

TEST(Verdict, AViewThatShowsNothingIsNotSeenEvenIfOthersShowAll) {
  Report report = reportOf(0.05);
  ViewResult away = reportOf(0.05, 0).scenes[0].views[0];
  away.whole = makeFigures(0, 0);
  away.checks.clear();
  report.scenes[0].views.push_back(away);
  settleVerdicts(report);
  EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::notSeen);
}

TEST(Verdict, NonFinitePixelsInTheWholeImageFail) {
  Report report = reportOf(0.05);
  report.scenes[0].views[0].whole.nonFinite = 1;
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
}

TEST(Verdict, BothAllBlackIsIdenticalAndJudgesNothingAndSaysSo) {
  Report report = reportOf(0);
  ViewResult& view = report.scenes[0].views[0];
  for (compare::Figures* figures : {&view.whole, &view.materials[0].figures}) {
    *figures = makeFigures(0, 4000, 1);
    figures->referenceLuma = figures->testLuma = figures->referenceLuminance = figures->testLuminance = 0;
    figures->clippedBlack = 1;
    figures->clippedWhite = 0;
  }
  judgeMaterial(view.materials[0], compare::defaultBudgets(), "s");
  judgeWhole(view, compare::defaultBudgets(), "s");
  settleVerdicts(report);
  const std::string why = "all pixels are black in both pictures, because neither path renders any light there";
  EXPECT_EQ(view.materials[0].verdict, compare::Verdict::notJudged);
  EXPECT_EQ(view.materials[0].reason, why);
  EXPECT_EQ(view.wholeVerdict, compare::Verdict::warn) << "of a whole image black may be meant";
  EXPECT_EQ(view.reason, why);
  EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::warn);
  EXPECT_EQ(report.verdict, compare::Verdict::error) << "no material was compared";
  EXPECT_NE(toTable(report, {}, {.all = true}).find("identical  both are black; all pixels"), std::string::npos)
      << toTable(report, {}, {.all = true});
  EXPECT_NE(toJson(report).find("\"bias\": \"both are black\""), std::string::npos);
}

TEST(Verdict, AMaterialOfFewPixelsIsTooSmallWhateverItsFiguresSay) {
  for (const double mean : {0.0, 0.05, 0.15, 0.9}) {
    Report report = reportOf(mean, 63);
    EXPECT_EQ(materialOf(report).verdict, compare::Verdict::tooSmall) << mean;
    EXPECT_EQ(materialOf(report).reason, "63 pixels, fewer than min_pixels = 64 of its budget");
    EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::tooSmall) << mean;
    EXPECT_EQ(countVerdicts(report).tooSmall, 1u);
    EXPECT_EQ(exitCode(besidesAPass(report), false), 0) << "a warning";
    EXPECT_EQ(exitCode(besidesAPass(report), true), 1);
  }
  Report one = reportOf(0.05, 1);
  EXPECT_EQ(materialOf(one).reason, "1 pixel, fewer than min_pixels = 64 of its budget");
}

TEST(Verdict, ExactlyTheLeastSizeIsJudged) {
  EXPECT_EQ(reportOf(0.05, 64).verdict, compare::Verdict::pass);
  EXPECT_EQ(reportOf(0.15, 64).verdict, compare::Verdict::warn);
  EXPECT_EQ(reportOf(0.25, 64).verdict, compare::Verdict::fail);
  compare::Budgets budgets = compare::defaultBudgets();
  for (const auto& [least, verdict] :
       {std::pair{1u, compare::Verdict::fail}, {12u, compare::Verdict::fail}, {13u, compare::Verdict::tooSmall}}) {
    budgets.materials[0].minPixels = least;
    MaterialResult material = makeMaterial("m", 0.25, 12);
    judgeMaterial(material, budgets, "s");
    EXPECT_EQ(material.verdict, verdict) << least;
  }
}

TEST(Verdict, AMaterialThatHasToBeSeenFailsWhereItIsTooSmall) {
  Report report = reportOf(0.05, 12);
  materialOf(report).rule.requireSeen = true;
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
  EXPECT_EQ(materialOf(report).reason,
            "12 pixels, fewer than min_pixels = 64 of its budget, but its budget requires that it is seen");
  report.scenes[0].views.push_back(reportOf(0.05).scenes[0].views[0]);
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::pass) << "the other view shows enough of it";
}

TEST(Verdict, ATooSmallMaterialThatAnotherViewShowsIsNotMissed) {
  Report report = reportOf(0.9, 12);
  ViewResult other = reportOf(0.05, 13).scenes[0].views[0];
  other.name = "behind";
  report.scenes[0].views.push_back(other);
  settleVerdicts(report);
  EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::tooSmall) << "too small in both";
  EXPECT_FALSE(materialOf(report).seenElsewhere);
  EXPECT_EQ(countVerdicts(report).tooSmall, 2u);

  report.scenes[0].views[1].materials[0] = makeMaterial("m", 0.05, 64);
  judgeMaterial(report.scenes[0].views[1].materials[0], compare::defaultBudgets(), "s");
  settleVerdicts(report);
  const MaterialResult& small = materialOf(report);
  EXPECT_TRUE(small.seenElsewhere);
  EXPECT_EQ(small.verdict, compare::Verdict::tooSmall);
  EXPECT_EQ(small.reason, "12 pixels, fewer than min_pixels = 64 of its budget in this view; view 'behind' shows it");
  EXPECT_EQ(report.verdict, compare::Verdict::pass);
  EXPECT_EQ(countVerdicts(report).total(), 1u);

  materialOf(report).figures = {};
  report.scenes[0].views[1] = reportOf(0.05, 12).scenes[0].views[0];
  settleVerdicts(report);
  EXPECT_FALSE(materialOf(report).seenElsewhere) << "a few pixels do not show it";
  EXPECT_EQ(countVerdicts(report).notSeen, 1u);
}

TEST(Verdict, NonFinitePixelsFailHoweverSmallTheMaterialIs) {
  Report report = reportOf(0.05, 12);
  materialOf(report).figures.nonFinite = 1;
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
  EXPECT_EQ(materialOf(report).reason, "1 of 12 pixels are NaN or infinite in one of the two renders");
  report.scenes[0].views.push_back(reportOf(0.05).scenes[0].views[0]);
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::fail) << "another view that shows it does not hide them";
}

TEST(Verdict, ClippingWarnsFromATwentiethOn) {
  for (const auto& [black, white] : {std::pair{0.049, 0.0}, {0.0, 0.049}, {0.02, 0.029}})
    EXPECT_EQ(withClipping(reportOf(0.05), black, white).verdict, compare::Verdict::pass) << black << " " << white;
  for (const auto& [black, white] : {std::pair{0.05, 0.0}, {0.0, 0.05}, {0.03, 0.03}, {0.0, 0.5}}) {
    Report report = withClipping(reportOf(0.05), black, white);
    EXPECT_EQ(report.verdict, compare::Verdict::warn) << black << " " << white;
    EXPECT_EQ(materialOf(report).reason, compare::describeClipping(materialOf(report).figures));
    EXPECT_EQ(exitCode(report, false), 0);
    EXPECT_EQ(exitCode(report, true), 1);
  }
}

TEST(Verdict, ClippingStandsBesideWhatElseWarnsAndHidesNoFailure) {
  Report warned = withClipping(reportOf(0.12), 0, 0.1);
  EXPECT_EQ(warned.verdict, compare::Verdict::warn);
  EXPECT_EQ(materialOf(warned).reason,
            "mean FLIP 0.120 is above 0.100; 10.0 % of the pixels are white in both pictures; lower --exposure");
  Report failed = withClipping(reportOf(0.25), 0, 0.1);
  EXPECT_EQ(failed.verdict, compare::Verdict::fail);
  EXPECT_EQ(materialOf(failed).reason, "mean FLIP 0.250 is above 0.200; 95th percentile of FLIP 0.625 is above 0.500; "
                                       "10.0 % of the pixels are white in both pictures; lower --exposure")
      << "no reason of it, but its reader should know";
}

TEST(Verdict, AMaterialThatIsMostlyClippedIsNotJudgedUnlessItFails) {
  for (const double mean : {0.0, 0.05, 0.15}) {
    Report report = withClipping(reportOf(mean), 0, 0.501);
    EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::notJudged) << mean;
    // What only warns is listed, and is no verdict.
    EXPECT_EQ(materialOf(report).reason,
              std::string(mean > 0.1 ? "mean FLIP 0.150 is above 0.100; 95th percentile of FLIP 0.375 is above 0.300; "
                                     : "") +
                  "50.1 % of the pixels are white in both pictures; lower --exposure");
    EXPECT_EQ(countVerdicts(report).notJudged, 1u);
    EXPECT_EQ(exitCode(besidesAPass(report), false), 0);
    EXPECT_EQ(exitCode(besidesAPass(report), true), 1);
  }
  EXPECT_EQ(withClipping(reportOf(0.05), 0.3, 0.3).scenes[0].verdict, compare::Verdict::notJudged);
  EXPECT_EQ(withClipping(reportOf(0.25), 0, 0.99).verdict, compare::Verdict::fail);
  EXPECT_EQ(withClipping(reportOf(0, 4000, 0.5), 0, 1).verdict, compare::Verdict::fail)
      << "white on white, but of half the light";
  Report broken = withClipping(reportOf(0.05), 0, 1);
  materialOf(broken).figures.nonFinite = 1;
  settleVerdicts(broken);
  EXPECT_EQ(broken.verdict, compare::Verdict::fail);
  Report unchecked = withClipping(reportOf(0.05), 0, 1);
  materialOf(unchecked).checks.clear();
  settleVerdicts(unchecked);
  EXPECT_EQ(unchecked.verdict, compare::Verdict::error);
}

TEST(Verdict, AWholeImageThatIsMostlyClippedWarns) {
  Report report = reportOf(0.05);
  ViewResult& view = report.scenes[0].views[0];
  view.whole.clippedBlack = 0.9;
  view.whole.clippedWhite = 0;
  settleVerdicts(report);
  EXPECT_EQ(view.wholeVerdict, compare::Verdict::warn);
  EXPECT_EQ(view.reason, "90.0 % of the pixels are black in both pictures; raise --exposure");
  EXPECT_EQ(report.verdict, compare::Verdict::warn);
}

TEST(Verdict, WhatNoPathModelsIsNeverAPlainPass) {
  Report report = reportOf(0);
  materialOf(report).notModelled = {"clearcoat", "sheen"};
  settleVerdicts(report);
  EXPECT_EQ(report.verdict, compare::Verdict::warn);
  EXPECT_EQ(materialOf(report).reason, "base layer only: parity does not model clearcoat, sheen");
  EXPECT_EQ(exitCode(report, true), 1);

  Report clipped = withClipping(report, 0.2, 0);
  EXPECT_EQ(materialOf(clipped).reason, "20.0 % of the pixels are black in both pictures; raise --exposure; base layer "
                                        "only: parity does not model clearcoat, sheen");
  Report failed = reportOf(0.25);
  materialOf(failed).notModelled = {"clearcoat"};
  settleVerdicts(failed);
  EXPECT_EQ(failed.verdict, compare::Verdict::fail);
  EXPECT_TRUE(materialOf(failed).reason.ends_with("; base layer only: parity does not model clearcoat"))
      << materialOf(failed).reason;
  Report unseen = reportOf(0, 0);
  materialOf(unseen).notModelled = {"clearcoat"};
  settleVerdicts(unseen);
  EXPECT_EQ(unseen.scenes[0].verdict, compare::Verdict::notSeen);
}

TEST(Verdict, GravityIsInTheOrderOfTheNames) {
  const std::vector<std::string> names = {"pass", "not seen", "too small", "not judged",
                                          "warn", "fail",     "not run",   "error"};
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(nameOf(static_cast<compare::Verdict>(i)), names[i]);
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
  EXPECT_EQ(exitCode(besidesAPass(reportOf(0, 0)), false), 0);
  EXPECT_EQ(exitCode(besidesAPass(reportOf(0, 0)), true), 1);
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
  setFigure(materialOf(report).figures, "rmse", NAN);
  settleVerdicts(report);
  EXPECT_EQ(exitCode(report, false), 4);
}

TEST(Verdict, CountsEachRowOnce) {
  const VerdictCounts counts = countVerdicts(makeSampleReport());
  EXPECT_EQ(counts.pass, 3u);      // Glass twice, Bulb in front
  EXPECT_EQ(counts.fail, 2u);      // Rough metal in both views
  EXPECT_EQ(counts.warn, 2u);      // Shade in both
  EXPECT_EQ(counts.notSeen, 2u);   // Screw in neither; Bulb, not seen from behind, is seen in front
  EXPECT_EQ(counts.tooSmall, 2u);  // Rivet
  EXPECT_EQ(counts.notJudged, 2u); // Lit panel
  EXPECT_EQ(counts.error, 0u);
  EXPECT_EQ(counts.total(), 13u);
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
  view.truth->figures.nonFinite = 3;
  view.materials[0].truth->figures.nonFinite = 3; // passed
  view.materials[1].truth->figures.nonFinite = 1; // failed
  settleVerdicts(report);
  EXPECT_EQ(view.materials[0].verdict, compare::Verdict::error);
  EXPECT_EQ(view.materials[0].reason, "3 of 90000 pixels of the truth are NaN or infinite");
  EXPECT_EQ(view.materials[1].verdict, compare::Verdict::error);
  EXPECT_EQ(view.materials[1].reason.find("1 of 120000 pixels of the truth are NaN or infinite; mean FLIP 0.270"), 0u)
      << view.materials[1].reason;
  EXPECT_EQ(view.wholeVerdict, compare::Verdict::error);
  EXPECT_EQ(view.reason, "3 of 400000 pixels of the truth are NaN or infinite");
  EXPECT_EQ(exitCode(report, false), 4);
}

} // namespace
} // namespace parity::report
