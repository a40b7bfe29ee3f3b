// A run against an earlier one: changes, new and gone, regressions, and that nothing passes that was not held against
// it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "compare/baseline.h"
#include "compare/budget.h"
#include "compare/sample_report.h"

namespace parity::compare {
namespace {

BudgetCheck limit(const char* figure, std::optional<double> warn, std::optional<double> fail,
                  Region region = Region::interior) {
  return {requireStatistic(figure, "test"), region, warn, fail};
}

// Levels of mean FLIP up to 0.5, and worse by 0.01 (warn) or 0.03 (fail) at most.
Budgets makeBudgets() {
  BudgetRule rule;
  rule.checks = {limit("flip.mean", std::nullopt, 0.5)};
  rule.regress = {limit("flip.mean", 0.01, 0.03)};
  BudgetRule whole;
  whole.checks = {limit("flip.mean", std::nullopt, 0.5, Region::all)};
  return {{rule}, {whole}};
}

// One view "v" of a scene "s" with these materials, of these mean FLIPs.
Report makeRun(const std::vector<std::pair<std::string, double>>& materials, const Budgets& budgets = makeBudgets()) {
  ViewResult view;
  view.name = "v";
  view.width = view.height = 64;
  view.whole = makeRegion("whole", 0.1, 8000);
  for (const auto& [name, mean] : materials) {
    view.materials.push_back(makeMaterial(name, mean, 4000));
    judgeMaterial(view.materials.back(), budgets, "s");
  }
  judgeWhole(view, budgets, "s");
  Report report;
  report.scenes.emplace_back().name = "s";
  report.scenes[0].views = {view};
  settleVerdicts(report);
  return report;
}

Report hold(Report report, const Report& baseline,
            const BaselineOptions& options = {"/here/old/report.json", {}, false}) {
  compareWithBaseline(report, baseline, options);
  return report;
}

const MaterialResult& materialOf(const Report& report, std::size_t index = 0) {
  return report.scenes[0].views[0].materials[index];
}

TEST(Baseline, ChangesAreNowMinusThen) {
  const Report report = hold(makeRun({{"a", 0.10}}), makeRun({{"a", 0.12}}));
  const BaselineChange& change = materialOf(report).baseline.value();
  EXPECT_FALSE(change.isNew);
  EXPECT_EQ(change.before, Verdict::pass);
  ASSERT_FALSE(change.interior.empty());
  EXPECT_EQ(change.interior[0].metric, "flip.mean");
  EXPECT_NEAR(change.interior[0].change(), -0.02, 1e-12);
  EXPECT_NEAR(change.all[0].change(), -0.022, 1e-12);
  EXPECT_EQ(report.baseline->common, 1u);
  EXPECT_EQ(report.baseline->source, "report.json") << "no folder of this machine";
  EXPECT_EQ(report.verdict, Verdict::pass);
  EXPECT_EQ(hold(report, report, {"old/report.json", {}, false}).baseline->source, "old/report.json")
      << "as it was given: old and new have the same name";
}

TEST(Baseline, ARegressionIsJudgedByHowMuchWorseItIs) {
  for (const auto& [mean, verdict] : {std::pair{0.05, Verdict::pass},
                                      {0.10, Verdict::pass},
                                      {0.105, Verdict::pass},
                                      {0.12, Verdict::warn},
                                      {0.14, Verdict::fail}}) {
    const Report report = hold(makeRun({{"a", mean}}), makeRun({{"a", 0.10}}));
    EXPECT_EQ(materialOf(report).verdict, verdict) << mean;
    EXPECT_EQ(report.verdict, verdict) << mean;
    EXPECT_NEAR(materialOf(report).checks[1].value, mean - 0.10, 1e-12);
  }
  EXPECT_EQ(materialOf(hold(makeRun({{"a", 0.14}}), makeRun({{"a", 0.10}}))).reason,
            "mean FLIP over interior pixels is 0.040 worse than in the baseline, above 0.030");
}

TEST(Baseline, WorseIsLessWhereMoreIsBetterAndFurtherFromZeroWhereSigned) {
  Budgets budgets = makeBudgets();
  budgets.materials[0].regress = {limit("psnr", 1, 3), limit("bias.ev", 0.1, 0.3)};
  const auto verdictOf = [&](double psnrThen, double psnrNow, double evThen, double evNow) {
    const auto make = [&](double psnr, double ev) {
      Report report = makeRun({{"a", 0.1}});
      MaterialResult& material = report.scenes[0].views[0].materials[0];
      setFigure(material.figures, "psnr", psnr);
      setFigure(material.figures, "bias.ev", ev);
      judgeMaterial(material, budgets, "s");
      settleVerdicts(report);
      return report;
    };
    return materialOf(hold(make(psnrNow, evNow), make(psnrThen, evThen))).verdict;
  };
  EXPECT_EQ(verdictOf(30, 40, 0, 0), Verdict::pass);
  EXPECT_EQ(verdictOf(30, 28, 0, 0), Verdict::warn);
  EXPECT_EQ(verdictOf(30, 26, 0, 0), Verdict::fail);
  EXPECT_EQ(verdictOf(INFINITY, INFINITY, 0, 0), Verdict::pass);
  EXPECT_EQ(verdictOf(INFINITY, 60, 0, 0), Verdict::fail) << "no longer identical";
  EXPECT_EQ(verdictOf(60, INFINITY, 0, 0), Verdict::pass);
  EXPECT_EQ(verdictOf(30, 30, -0.5, 0.5), Verdict::pass) << "as far off as before, on the other side";
  EXPECT_EQ(verdictOf(30, 30, -0.5, -0.7), Verdict::warn);
  EXPECT_EQ(verdictOf(30, 30, 0.1, -0.5), Verdict::fail);
}

TEST(Baseline, WithoutOneRegressionsAreNotJudgedAndSaySo) {
  const Report report = makeRun({{"a", 0.10}});
  const CheckResult& check = materialOf(report).checks.at(1);
  EXPECT_FALSE(check.judged());
  EXPECT_EQ(check.unjudged, "no baseline");
  EXPECT_EQ(materialOf(report).verdict, Verdict::pass) << "its level was judged";
  EXPECT_NE(toTable(report, false).find("regressions not judged: 1 (no --baseline was given)"), std::string::npos);
  EXPECT_NE(toJson(report).find("\"verdict\": \"not judged\""), std::string::npos);
}

TEST(Baseline, ARuleOfRegressionsAloneIsAnErrorWithoutOne) {
  Budgets budgets = makeBudgets();
  budgets.materials[0].checks.clear();
  const Report alone = makeRun({{"a", 0.10}}, budgets);
  EXPECT_EQ(materialOf(alone).verdict, Verdict::error);
  EXPECT_EQ(materialOf(alone).reason,
            "its budget holds regressions only: regression of mean FLIP over interior pixels: no baseline");
  EXPECT_EQ(exitCode(alone, false), 4);
  EXPECT_EQ(materialOf(hold(alone, makeRun({{"a", 0.10}}))).verdict, Verdict::pass);
}

TEST(Baseline, WhatIsNewIsMarkedAndAWarningWhereNothingElseJudgesIt) {
  const Report report = hold(makeRun({{"a", 0.10}, {"b", 0.10}}), makeRun({{"a", 0.10}}));
  EXPECT_TRUE(materialOf(report, 1).baseline->isNew);
  EXPECT_EQ(materialOf(report, 1).verdict, Verdict::pass) << "its level was judged";
  EXPECT_EQ(materialOf(report, 1).checks[1].unjudged, "new, the baseline does not have it");

  Budgets budgets = makeBudgets();
  budgets.materials[0].checks.clear();
  const Report only = hold(makeRun({{"a", 0.10}, {"b", 0.10}}, budgets), makeRun({{"a", 0.10}}));
  EXPECT_EQ(materialOf(only, 1).verdict, Verdict::warn);
}

TEST(Baseline, WhatIsGoneIsAWarningAtLeast) {
  const Report report = hold(makeRun({{"a", 0.10}}), makeRun({{"a", 0.10}, {"b", 0.10}}));
  ASSERT_EQ(report.baseline->gone.size(), 1u);
  EXPECT_EQ(report.baseline->gone[0].material, "b");
  EXPECT_EQ(report.verdict, Verdict::warn);
  EXPECT_EQ(exitCode(report, false), 0);
  EXPECT_EQ(exitCode(report, true), 1);
  EXPECT_NE(toTable(report, false).find("warning: gone: material 'b', scene s, view v"), std::string::npos);
}

TEST(Baseline, ViewsAndScenesGoToo) {
  Report before = makeRun({{"a", 0.10}});
  before.scenes[0].views.push_back(before.scenes[0].views[0]);
  before.scenes[0].views[1].name = "behind";
  before.scenes.push_back(before.scenes[0]);
  before.scenes[1].name = "t";
  const Report report = hold(makeRun({{"a", 0.10}}), before);
  ASSERT_EQ(report.baseline->gone.size(), 2u);
  EXPECT_EQ(report.baseline->gone[0].view, "behind");
  EXPECT_EQ(report.baseline->gone[1].scene, "t");
  EXPECT_EQ(report.baseline->gone[1].view, "");
  EXPECT_EQ(hold(makeRun({{"a", 0.10}}), before, {"x", {}, true}).baseline->gone.size(), 1u)
      << "parity diff shows one scene of many";
}

TEST(Baseline, WhatWasNotAskedForOrCouldNotBeComparedIsNotGone) {
  const Report before = makeRun({{"a", 0.10}, {"b", 0.10}});
  EXPECT_TRUE(hold(makeRun({{"a", 0.10}}), before, {"x", {"a*"}, false}).baseline->gone.empty());

  Report broken = makeRun({{"a", 0.10}});
  broken.scenes[0].error = "s.glb: broken half-way";
  EXPECT_TRUE(hold(broken, before).baseline->gone.empty());
  Report brokenBefore = before;
  brokenBefore.scenes.emplace_back().name = "t";
  brokenBefore.scenes[1].error = "t.glb: missing";
  EXPECT_EQ(hold(makeRun({{"a", 0.10}, {"b", 0.10}}), brokenBefore).verdict, Verdict::pass);
}

TEST(Baseline, NothingInCommonIsAnError) {
  const Report report = hold(makeRun({{"a", 0.10}}), makeRun({{"b", 0.10}}));
  EXPECT_EQ(report.verdict, Verdict::error);
  EXPECT_NE(report.baseline->error.find("nothing in common"), std::string::npos);
  EXPECT_EQ(exitCode(report, false), 4);
  EXPECT_NE(toTable(report, false).find("error: baseline: nothing in common"), std::string::npos);
  EXPECT_EQ(hold(makeRun({{"a", 0.10}}), Report{}).verdict, Verdict::error) << "a baseline without scenes";

  Report unseen = makeRun({{"a", 0.10}});
  unseen.scenes[0].views[0].materials[0].figures = makeRegion("a", 0, 0);
  EXPECT_EQ(hold(makeRun({{"a", 0.10}}), unseen).verdict, Verdict::error) << "it shows nothing that could be held";
}

TEST(Baseline, AFigureThatWasNotMeasuredThenIsAnError) {
  Report before = makeRun({{"a", 0.10}});
  for (Figures* figures :
       {&before.scenes[0].views[0].materials[0].figures.interior, &before.scenes[0].views[0].materials[0].figures.all})
    std::erase_if(figures->values, [](const Figure& f) { return f.name == "flip.mean"; });
  const Report report = hold(makeRun({{"a", 0.10}}), before);
  EXPECT_EQ(materialOf(report).verdict, Verdict::error);
  EXPECT_EQ(materialOf(report).reason, "mean FLIP over interior pixels: not measured in the baseline");

  Report broken = makeRun({{"a", 0.10}});
  setFigure(broken.scenes[0].views[0].materials[0].figures, "flip.mean", NAN);
  EXPECT_EQ(materialOf(hold(makeRun({{"a", 0.10}}), broken)).verdict, Verdict::error);
}

// Non-finite pixels count as the worst error, so that against them any regression looks like an improvement.
TEST(Baseline, NonFinitePixelsInItHideNoRegression) {
  Report before = makeRun({{"a", 0.40}});
  before.scenes[0].views[0].materials[0].figures.all.nonFinite = 3; // in the rim, whose neighbours are in the interior
  const Report report = hold(makeRun({{"a", 0.30}}), before);
  EXPECT_EQ(materialOf(report).verdict, Verdict::error);
  EXPECT_EQ(materialOf(report).reason, "mean FLIP over interior pixels: non-finite pixels in the baseline");
  EXPECT_EQ(exitCode(report, false), 4);
  before.scenes[0].views[0].materials[0].figures.interior.nonFinite = 3;
  EXPECT_TRUE(materialOf(hold(makeRun({{"a", 0.30}}), before)).baseline->interior.empty()) << "no change to speak of";
}

TEST(Baseline, AFigureThatIsNotMeasuredNowIsAnErrorWithAndWithoutOne) {
  Budgets budgets = makeBudgets();
  budgets.materials[0].regress = {limit("maxabs", 0.01, 0.03)};
  const Report report = makeRun({{"a", 0.10}}, budgets);
  EXPECT_EQ(materialOf(report).verdict, Verdict::error);
  EXPECT_EQ(materialOf(hold(report, makeRun({{"a", 0.10}}))).verdict, Verdict::error);
}

TEST(Baseline, NamesakesAreToldApartByTheirOrder) {
  const Report report = hold(makeRun({{"a", 0.10}, {"a", 0.30}}), makeRun({{"a", 0.10}, {"x", 0.2}, {"a", 0.20}}));
  EXPECT_NEAR(materialOf(report, 0).baseline->interior[0].change(), 0, 1e-12);
  EXPECT_NEAR(materialOf(report, 1).baseline->interior[0].change(), 0.1, 1e-12);
  const Report fewer = hold(makeRun({{"a", 0.10}}), makeRun({{"a", 0.10}, {"a", 0.20}}));
  ASSERT_EQ(fewer.baseline->gone.size(), 1u);
}

TEST(Baseline, WholeImagesRegressToo) {
  Budgets budgets = makeBudgets();
  budgets.wholes[0].regress = {limit("flip.mean", 0.01, 0.03, Region::all)};
  Report now = makeRun({{"a", 0.1}}, budgets);
  now.scenes[0].views[0].whole = makeRegion("whole", 0.2, 8000);
  judgeWhole(now.scenes[0].views[0], budgets, "s");
  const Report report = hold(now, makeRun({{"a", 0.1}}));
  EXPECT_EQ(report.scenes[0].views[0].wholeVerdict, Verdict::fail);
  EXPECT_EQ(report.verdict, Verdict::fail);
}

// With --material or --fully-rough the whole image is of other surfaces: a change of it says nothing.
TEST(Baseline, WholeImagesOfOtherMaterialsAreNotHeldAgainstEachOther) {
  Budgets budgets = makeBudgets();
  budgets.wholes[0].regress = {limit("flip.mean", 0.01, 0.03, Region::all)};
  for (const char* name : {"materials", "fully rough"}) {
    Report before = makeRun({{"a", 0.1}}, budgets), now = before;
    before.settings = {{"materials", "all"}, {"fully rough", "all"}};
    now.settings = before.settings;
    (name == std::string("materials") ? now.settings[0] : now.settings[1]).second = "Hero*";
    const Report report = hold(now, before);
    const ViewResult& view = report.scenes[0].views[0];
    const std::string why = std::string("the whole image was of another choice (") + name + " 'all', now 'Hero*')";
    EXPECT_EQ(view.checks.at(1).unjudged, why);
    EXPECT_EQ(view.wholeVerdict, Verdict::pass) << "its level was judged";
    EXPECT_TRUE(view.baseline->all.empty());
    EXPECT_FALSE(materialOf(report).baseline->all.empty());
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_NE(report.warnings[0].find(name + std::string(" was 'all', is 'Hero*'")), std::string::npos);

    Budgets only = budgets;
    only.wholes[0].checks.clear();
    judgeWhole(now.scenes[0].views[0], only, "s");
    EXPECT_EQ(hold(now, before).scenes[0].views[0].wholeVerdict, Verdict::warn) << "nothing else judges it";

    before.settings.clear();
    EXPECT_FALSE(hold(now, before).scenes[0].views[0].checks.at(0).judged()) << "a baseline that does not say";
  }
}

TEST(Baseline, OtherConditionsAreAWarningInWords) {
  Report before = makeRun({{"a", 0.10}}), now = before;
  before.settings = {{"size", "64x64"}, {"samples", "1"}};
  now.settings = {{"size", "128x128"}, {"samples", "1"}};
  before.scenes[0].sun = "none";
  now.scenes[0].sun = "30,50,4";
  now.scenes[0].light = "fog";
  const Report report = hold(now, before);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("size was '64x64', is '128x128'; sun of scene s was 'none', is '30,50,4'; light of "
                                    "scene s was '', is 'fog'"),
            std::string::npos)
      << report.warnings[0];
  EXPECT_TRUE(hold(now, now).warnings.empty());
}

TEST(Baseline, ATruthOnEitherSideMakesNoDifference) {
  Report before = makeSampleReportWithTruth();
  before.settings.back().second = "single scattering"; // what is held against it does not depend on the truth
  for (Report now : {makeSampleReport(), makeSampleReportWithTruth()}) {
    compareWithBaseline(now, before, {"old.json", {}, false});
    EXPECT_TRUE(now.warnings.empty()) << now.warnings[0];
    EXPECT_EQ(now.baseline->error, "");
    for (const FigureChange& change : now.scenes[0].views[0].materials[1].baseline->interior)
      EXPECT_EQ(change.change(), 0) << change.metric;
  }
}

} // namespace
} // namespace parity::compare
