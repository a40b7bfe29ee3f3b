// A run against an earlier one: changes, new and gone, regressions, and that nothing passes that was not held against
// it.
#include <algorithm>
#include <cmath>
#include <csignal>

#include <gtest/gtest.h>

#include "compare/verdict/budget.h"
#include "report/baseline.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

compare::BudgetCheck limit(const char* figure, std::optional<double> warn, std::optional<double> fail) {
  return {compare::requireStatistic(figure, "test"), warn, fail};
}

// Levels of mean FLIP up to 0.5, and worse by 0.01 (warn) or 0.03 (fail) at most.
compare::Budgets makeBudgets() {
  compare::BudgetRule rule;
  rule.checks = {limit("flip.mean", std::nullopt, 0.5)};
  rule.regress = {limit("flip.mean", 0.01, 0.03)};
  compare::BudgetRule whole;
  whole.checks = {limit("flip.mean", std::nullopt, 0.5)};
  return {{rule}, {whole}};
}

// One view "v" of a scene "s" with these materials, of these mean FLIPs.
Report makeRun(const std::vector<std::pair<std::string, double>>& materials,
               const compare::Budgets& budgets = makeBudgets()) {
  ViewResult view;
  view.name = "v";
  view.width = view.height = 64;
  view.whole = makeFigures(0.1, 8000);
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
  EXPECT_EQ(change.before, compare::Verdict::pass);
  ASSERT_FALSE(change.changes.empty());
  EXPECT_EQ(change.changes[0].metric, "flip.mean");
  EXPECT_NEAR(change.changes[0].change(), -0.02, 1e-12);
  EXPECT_EQ(report.baseline->common, 1u);
  EXPECT_EQ(report.baseline->source, "report.json") << "no folder of this machine";
  EXPECT_EQ(report.verdict, compare::Verdict::pass);
  EXPECT_EQ(hold(report, report, {"old/report.json", {}, false}).baseline->source, "old/report.json")
      << "as it was given: old and new have the same name";
}

TEST(Baseline, ARegressionIsJudgedByHowMuchWorseItIs) {
  for (const auto& [mean, verdict] : {std::pair{0.05, compare::Verdict::pass},
                                      {0.10, compare::Verdict::pass},
                                      {0.105, compare::Verdict::pass},
                                      {0.12, compare::Verdict::warn},
                                      {0.14, compare::Verdict::fail}}) {
    const Report report = hold(makeRun({{"a", mean}}), makeRun({{"a", 0.10}}));
    EXPECT_EQ(materialOf(report).verdict, verdict) << mean;
    EXPECT_EQ(report.verdict, verdict) << mean;
    EXPECT_NEAR(materialOf(report).checks[1].value, mean - 0.10, 1e-12);
  }
  EXPECT_EQ(materialOf(hold(makeRun({{"a", 0.14}}), makeRun({{"a", 0.10}}))).reason,
            "mean FLIP is 0.040 worse than in the baseline, above 0.030");
}

TEST(Baseline, WorseIsLessWhereMoreIsBetterAndFurtherFromZeroWhereSigned) {
  compare::Budgets budgets = makeBudgets();
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
  EXPECT_EQ(verdictOf(30, 40, 0, 0), compare::Verdict::pass);
  EXPECT_EQ(verdictOf(30, 28, 0, 0), compare::Verdict::warn);
  EXPECT_EQ(verdictOf(30, 26, 0, 0), compare::Verdict::fail);
  EXPECT_EQ(verdictOf(INFINITY, INFINITY, 0, 0), compare::Verdict::pass);
  EXPECT_EQ(verdictOf(INFINITY, 60, 0, 0), compare::Verdict::fail) << "no longer identical";
  EXPECT_EQ(verdictOf(60, INFINITY, 0, 0), compare::Verdict::pass);
  EXPECT_EQ(verdictOf(30, 30, -0.5, 0.5), compare::Verdict::pass) << "as far off as before, on the other side";
  EXPECT_EQ(verdictOf(30, 30, -0.5, -0.7), compare::Verdict::warn);
  EXPECT_EQ(verdictOf(30, 30, 0.1, -0.5), compare::Verdict::fail);
}

TEST(Baseline, WithoutOneRegressionsAreNotJudgedAndSaySo) {
  const Report report = makeRun({{"a", 0.10}});
  const compare::CheckResult& check = materialOf(report).checks.at(1);
  EXPECT_FALSE(check.judged());
  EXPECT_EQ(check.unjudged, "no baseline");
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::pass) << "its level was judged";
  EXPECT_NE(toTable(report, {}, {.all = true}).find("regressions not judged: 1 (no --baseline was given)"),
            std::string::npos);
  EXPECT_NE(toJson(report).find("\"verdict\": \"not judged\""), std::string::npos);
}

TEST(Baseline, ARuleOfRegressionsAloneIsAnErrorWithoutOne) {
  compare::Budgets budgets = makeBudgets();
  budgets.materials[0].checks.clear();
  const Report alone = makeRun({{"a", 0.10}}, budgets);
  EXPECT_EQ(materialOf(alone).verdict, compare::Verdict::error);
  EXPECT_EQ(materialOf(alone).reason, "no check of its budget could be judged: regression of mean FLIP: no baseline");
  EXPECT_EQ(exitCode(alone, false), 4);
  EXPECT_EQ(materialOf(hold(alone, makeRun({{"a", 0.10}}))).verdict, compare::Verdict::pass);
}

TEST(Baseline, WhatIsNewIsMarkedAndAWarningWhereNothingElseJudgesIt) {
  const Report report = hold(makeRun({{"a", 0.10}, {"b", 0.10}}), makeRun({{"a", 0.10}}));
  EXPECT_TRUE(materialOf(report, 1).baseline->isNew);
  EXPECT_EQ(materialOf(report, 1).verdict, compare::Verdict::pass) << "its level was judged";
  EXPECT_EQ(materialOf(report, 1).checks[1].unjudged, "new: the baseline does not have it");

  compare::Budgets budgets = makeBudgets();
  budgets.materials[0].checks.clear();
  const Report only = hold(makeRun({{"a", 0.10}, {"b", 0.10}}, budgets), makeRun({{"a", 0.10}}));
  EXPECT_EQ(materialOf(only, 1).verdict, compare::Verdict::warn);
}

TEST(Baseline, WhatIsGoneIsAWarningAtLeast) {
  const Report report = hold(makeRun({{"a", 0.10}}), makeRun({{"a", 0.10}, {"b", 0.10}}));
  ASSERT_EQ(report.baseline->gone.size(), 1u);
  EXPECT_EQ(report.baseline->gone[0].material, "b");
  EXPECT_EQ(report.verdict, compare::Verdict::warn);
  EXPECT_EQ(exitCode(report, false), 0);
  EXPECT_EQ(exitCode(report, true), 1);
  EXPECT_NE(toTable(report, {}, {.all = true}).find("warning: gone: material 'b', scene s, view v"), std::string::npos);
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
  EXPECT_EQ(hold(makeRun({{"a", 0.10}, {"b", 0.10}}), brokenBefore).verdict, compare::Verdict::pass);
}

TEST(Baseline, NothingInCommonIsAnError) {
  const Report report = hold(makeRun({{"a", 0.10}}), makeRun({{"b", 0.10}}));
  EXPECT_EQ(report.verdict, compare::Verdict::error);
  EXPECT_NE(report.baseline->error.find("no material of this run is visible in the baseline"), std::string::npos);
  EXPECT_EQ(exitCode(report, false), 4);
  EXPECT_NE(toTable(report, {}, {.all = true}).find("error: baseline: no material of this run is visible"),
            std::string::npos);
  EXPECT_EQ(hold(makeRun({{"a", 0.10}}), Report{}).verdict, compare::Verdict::error) << "a baseline without scenes";

  Report unseen = makeRun({{"a", 0.10}});
  unseen.scenes[0].views[0].materials[0].figures = makeFigures(0, 0);
  EXPECT_EQ(hold(makeRun({{"a", 0.10}}), unseen).verdict, compare::Verdict::error)
      << "it shows nothing that could be held";
}

TEST(Baseline, AFigureThatWasNotMeasuredThenIsAnError) {
  Report before = makeRun({{"a", 0.10}});
  std::erase_if(before.scenes[0].views[0].materials[0].figures.values,
                [](const compare::Figure& f) { return f.name == "flip.mean"; });
  const Report report = hold(makeRun({{"a", 0.10}}), before);
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::error);
  EXPECT_EQ(materialOf(report).reason, "mean FLIP: not measured in the baseline");

  Report broken = makeRun({{"a", 0.10}});
  setFigure(broken.scenes[0].views[0].materials[0].figures, "flip.mean", NAN);
  EXPECT_EQ(materialOf(hold(makeRun({{"a", 0.10}}), broken)).verdict, compare::Verdict::error);
}

// Non-finite pixels count as the worst error, so that against them any regression looks like an improvement.
TEST(Baseline, NonFinitePixelsInItHideNoRegression) {
  Report before = makeRun({{"a", 0.40}});
  before.scenes[0].views[0].materials[0].figures.nonFinite = 3;
  const Report report = hold(makeRun({{"a", 0.30}}), before);
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::error);
  EXPECT_EQ(materialOf(report).reason, "mean FLIP: non-finite pixels in the baseline");
  EXPECT_EQ(exitCode(report, false), 4);
  EXPECT_TRUE(materialOf(report).baseline->changes.empty()) << "no change to speak of";
}

TEST(Baseline, AFigureThatIsNotMeasuredNowIsAnErrorWithAndWithoutOne) {
  compare::Budgets budgets = makeBudgets();
  budgets.materials[0].regress = {limit("maxabs", 0.01, 0.03)};
  const Report report = makeRun({{"a", 0.10}}, budgets);
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::error);
  EXPECT_EQ(materialOf(hold(report, makeRun({{"a", 0.10}}))).verdict, compare::Verdict::error);
}

// A surface that has become too small is judged by nothing, a regression neither.
TEST(Baseline, WhatIsTooSmallNowIsHeldAgainstItAndNotJudged) {
  Report now = makeRun({{"a", 0.30}});
  MaterialResult& small = now.scenes[0].views[0].materials[0];
  small.figures = makeFigures(0.30, 12);
  judgeMaterial(small, makeBudgets(), "s");
  const Report report = hold(now, makeRun({{"a", 0.10}}));
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::tooSmall);
  EXPECT_EQ(report.scenes[0].verdict, compare::Verdict::tooSmall);
  EXPECT_NEAR(materialOf(report).baseline->changes.at(0).change(), 0.20, 1e-12) << "the change is told all the same";
}

TEST(Baseline, NamesakesAreToldApartByTheirOrder) {
  const Report report = hold(makeRun({{"a", 0.10}, {"a", 0.30}}), makeRun({{"a", 0.10}, {"x", 0.2}, {"a", 0.20}}));
  EXPECT_NEAR(materialOf(report, 0).baseline->changes[0].change(), 0, 1e-12);
  EXPECT_NEAR(materialOf(report, 1).baseline->changes[0].change(), 0.1, 1e-12);
  const Report fewer = hold(makeRun({{"a", 0.10}}), makeRun({{"a", 0.10}, {"a", 0.20}}));
  ASSERT_EQ(fewer.baseline->gone.size(), 1u);
}

TEST(Baseline, WholeImagesRegressToo) {
  compare::Budgets budgets = makeBudgets();
  budgets.wholes[0].regress = {limit("flip.mean", 0.01, 0.03)};
  Report now = makeRun({{"a", 0.1}}, budgets);
  now.scenes[0].views[0].whole = makeFigures(0.2, 8000);
  judgeWhole(now.scenes[0].views[0], budgets, "s");
  const Report report = hold(now, makeRun({{"a", 0.1}}));
  EXPECT_EQ(report.scenes[0].views[0].wholeVerdict, compare::Verdict::fail);
  EXPECT_EQ(report.verdict, compare::Verdict::fail);
}

// A run whose conditions are these, of the run, the scene and the view.
Report makeRunUnder(const std::vector<compare::Condition>& run, const std::vector<compare::Condition>& scene,
                    const std::vector<compare::Condition>& view, double mean = 0.1,
                    const compare::Budgets& budgets = makeBudgets()) {
  Report report = makeRun({{"a", mean}}, budgets);
  report.conditions = run;
  report.scenes[0].conditions = scene;
  report.scenes[0].views[0].conditions = view;
  return report;
}

TEST(Baseline, OtherConditionsOnAnyLevelAreNotComparableAndNeitherRegressionNorPass) {
  compare::Budgets budgets = makeBudgets();
  budgets.wholes[0].regress = {limit("flip.mean", 0.01, 0.03)};
  const std::vector<compare::Condition> none;
  const Report now =
      makeRunUnder({{"samples", "4"}}, {{"environment rotation", "90"}}, {{"field of view", "44"}}, 0.4, budgets);
  const std::vector<std::pair<Report, std::string>> cases = {
      {makeRunUnder({{"samples", "1"}}, {{"environment rotation", "90"}}, {{"field of view", "44"}}, 0.1, budgets),
       "samples was 1, is 4"},
      {makeRunUnder({{"samples", "4"}}, {{"environment rotation", "0"}}, {{"field of view", "44"}}, 0.1, budgets),
       "environment rotation was 0, is 90"},
      {makeRunUnder({{"samples", "4"}}, {{"environment rotation", "90"}}, {{"field of view", "45"}}, 0.1, budgets),
       "field of view was 45, is 44"},
      {makeRunUnder({{"samples", "4"}}, none, {{"field of view", "44"}}, 0.1, budgets),
       "environment rotation was not recorded, is 90"},
      {makeRunUnder({{"samples", "4"}, {"taps", "3"}}, {{"environment rotation", "90"}}, {{"field of view", "45"}}, 0.1,
                    budgets),
       "taps was 3, is not recorded; field of view was 45, is 44"}};
  EXPECT_EQ(materialOf(hold(now, makeRunUnder(now.conditions, now.scenes[0].conditions,
                                              now.scenes[0].views[0].conditions, 0.1, budgets)))
                .verdict,
            compare::Verdict::fail)
      << "a regression of 0.3 under the same conditions";
  for (const auto& [before, sentence] : cases) {
    const Report report = hold(now, before);
    const ViewResult& view = report.scenes[0].views[0];
    EXPECT_EQ(materialOf(report).checks.at(1).unjudged, "not comparable: " + sentence);
    EXPECT_EQ(materialOf(report).verdict, compare::Verdict::warn) << sentence;
    EXPECT_EQ(materialOf(report).reason, "not comparable to the baseline: " + sentence);
    EXPECT_EQ(materialOf(report).baseline->notComparable, sentence);
    EXPECT_EQ(view.checks.at(1).unjudged, "not comparable: " + sentence);
    EXPECT_EQ(view.wholeVerdict, compare::Verdict::warn) << sentence;
    for (const BaselineChange& change : {*materialOf(report).baseline, *view.baseline}) {
      EXPECT_TRUE(change.changes.empty()) << sentence;
      EXPECT_FALSE(change.isNew);
    }
    EXPECT_EQ(report.baseline->notComparable, 2u);
    EXPECT_EQ(report.baseline->common, 1u);
    EXPECT_EQ(exitCode(report, false), 0);
    EXPECT_EQ(exitCode(report, true), 1);
    EXPECT_NE(toGithubAnnotations(report, ".").find("not comparable to the baseline: " + sentence), std::string::npos);
    EXPECT_NE(
        toTable(report, {}, {.all = true}).find("regressions not judged: 2 (the baseline has no comparable figures"),
        std::string::npos);
    // The same again, better than the baseline: no more comparable, so no pass either.
    Report better = makeRunUnder(now.conditions, now.scenes[0].conditions, now.scenes[0].views[0].conditions, 0.01);
    EXPECT_EQ(materialOf(hold(better, before)).verdict, compare::Verdict::warn) << sentence;
  }
}

TEST(Baseline, ARunOfWhichNoLimitCouldBeJudgedIsAnError) {
  compare::Budgets regressions = makeBudgets();
  regressions.materials[0].checks.clear();
  regressions.wholes[0].checks.clear();
  regressions.wholes[0].regress = regressions.materials[0].regress;
  const auto run = [](const char* samples, const compare::Budgets& budgets) {
    return makeRunUnder({{"samples", samples}}, {}, {}, 0.1, budgets);
  };
  const Report none = hold(run("4", regressions), run("1", regressions));
  EXPECT_EQ(exitCode(none, false), 4);
  EXPECT_EQ(problemsOf(none).at(0).reason,
            "no limit was judged: the budgets limit only regressions, and the baseline has no comparable figures");
  EXPECT_EQ(exitCode(hold(run("4", regressions), run("4", regressions)), true), 0);
  compare::Budgets ofWholes = regressions;
  ofWholes.wholes = makeBudgets().wholes;
  EXPECT_EQ(exitCode(hold(run("4", ofWholes), run("1", ofWholes)), false), 0) << "the whole image is judged";
}

TEST(Baseline, WhatOnlyDidNotAskForIsNotGone) {
  Report before = makeRun({{"a", 0.1}});
  before.scenes[0].views.push_back(before.scenes[0].views[0]);
  before.scenes[0].views[1].name = "w";
  before.scenes.push_back(before.scenes[0]);
  before.scenes[1].name = "t";
  const Report now = makeRun({{"a", 0.1}});
  const auto goneWith = [&](const std::vector<std::string>& only) {
    return hold(now, before, {.source = "", .materials = {}, .only = only}).baseline->gone.size();
  };
  EXPECT_EQ(goneWith({}), 2u) << "the view and the scene";
  EXPECT_EQ(goneWith({"s/v"}), 0u);
  EXPECT_EQ(goneWith({"s"}), 1u) << "its other view was asked for";
  EXPECT_EQ(goneWith({"s/v", "t/w"}), 1u) << "the scene was asked for";
}

TEST(Baseline, ASceneWithoutAMaterialThatWasAskedForIsNotGone) {
  Report before = makeRun({{"a", 0.1}, {"b", 0.1}});
  before.scenes.push_back(makeRun({{"b", 0.1}}).scenes[0]);
  before.scenes[1].name = "t";
  const Report now = makeRun({{"a", 0.1}});
  EXPECT_TRUE(hold(now, before, {.source = "", .materials = {"a"}}).baseline->gone.empty());
  EXPECT_EQ(hold(now, before, {.source = "", .materials = {"*"}}).baseline->gone.size(), 2u);
}

TEST(Baseline, WhatAnInterruptedRunDidNotGetToIsNotGone) {
  const Report before = makeRun({{"a", 0.1}});
  Report now = makeRun({{"a", 0.1}});
  now.scenes[0].views.clear();
  setNotRun(now.scenes[0], SIGINT);
  now = hold(now, before);
  EXPECT_TRUE(now.baseline->gone.empty());
  EXPECT_EQ(now.baseline->error, "");
  EXPECT_EQ(now.verdict, compare::Verdict::notRun);
}

TEST(Baseline, ARuleOfRegressionsAloneWarnsWhereNothingIsComparable) {
  compare::Budgets budgets = makeBudgets();
  budgets.materials[0].checks.clear();
  const Report before = makeRunUnder({}, {{"variant", "none"}}, {}, 0.1, budgets);
  const Report report = hold(makeRunUnder({}, {{"variant", "'beach'"}}, {}, 0.1, budgets), before);
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::warn);
  EXPECT_EQ(materialOf(report).reason,
            "no check of its budget could be judged: regression of mean FLIP: not comparable: "
            "variant was none, is 'beach'");
}

TEST(Baseline, WhatFailsByItselfFailsUnderOtherConditionsToo) {
  const Report before = makeRunUnder({}, {{"time", "0", compare::ActsOn::figures, "0 s"}}, {});
  const Report report = hold(makeRunUnder({}, {{"time", "1", compare::ActsOn::figures, "1 s"}}, {}, 0.6), before);
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::fail);
  EXPECT_EQ(materialOf(report).reason, "mean FLIP 0.600 is above 0.500; not comparable to the "
                                       "baseline: time was 0 s, is 1 s");
}

TEST(Baseline, WordsThatAreTheSameHideNoOtherValue) {
  const Report before = makeRunUnder({}, {{"environment", "0a", compare::ActsOn::figures, "studio.hdr"}}, {});
  const Report report =
      hold(makeRunUnder({}, {{"environment", "0b", compare::ActsOn::figures, "studio.hdr"}}, {}), before);
  EXPECT_EQ(materialOf(report).baseline->notComparable, "environment was 0a, is 0b");
  const Report renamed =
      hold(makeRunUnder({}, {{"environment", "0a", compare::ActsOn::figures, "other.hdr"}}, {}), before);
  EXPECT_EQ(materialOf(renamed).verdict, compare::Verdict::pass) << "the value is the same";
}

TEST(Baseline, ADeviceIsACondition) {
  Report before = makeRun({{"a", 0.1}}), now = before;
  before.device = "llvmpipe (Mesa 22)";
  now.device = "llvmpipe (Mesa 23)";
  EXPECT_EQ(materialOf(hold(now, before)).baseline->notComparable,
            "device was llvmpipe (Mesa 22), is llvmpipe (Mesa 23)");
}

TEST(Baseline, WhatIsNewOrNotSeenIsNotCalledNotComparable) {
  const Report before = makeRunUnder({{"samples", "1"}}, {}, {});
  Report now = makeRun({{"a", 0.1}, {"b", 0.1}});
  now.conditions = {{"samples", "4"}};
  now.scenes[0].views[0].materials[0].figures = makeFigures(0, 0);
  now.scenes[0].views[0].materials[0].checks.clear();
  const Report report = hold(now, before);
  EXPECT_EQ(materialOf(report, 0).verdict, compare::Verdict::notSeen);
  EXPECT_TRUE(materialOf(report, 1).baseline->isNew);
  EXPECT_EQ(materialOf(report, 1).verdict, compare::Verdict::pass) << "its level was judged";
  EXPECT_EQ(report.baseline->notComparable, 1u) << "the whole image";
}

// With --material the whole image is of other surfaces: a change of it says nothing; those of the materials do.
TEST(Baseline, ConditionsOfWholeImagesAreThoseOfNoMaterial) {
  const Report before = makeRunUnder({{"materials", "all", compare::ActsOn::wholes}}, {}, {});
  const Report now = makeRunUnder({{"materials", "'Hero*'", compare::ActsOn::wholes}}, {}, {});
  const Report report = hold(now, before);
  const ViewResult& view = report.scenes[0].views[0];
  EXPECT_EQ(view.wholeVerdict, compare::Verdict::warn);
  EXPECT_EQ(view.baseline->notComparable, "materials was all, is 'Hero*'");
  EXPECT_TRUE(view.baseline->changes.empty());
  EXPECT_EQ(materialOf(report).verdict, compare::Verdict::pass);
  EXPECT_EQ(materialOf(report).baseline->notComparable, "");
  EXPECT_FALSE(materialOf(report).baseline->changes.empty());
}

TEST(Baseline, OtherConditionsAreOneWarningThatSaysEachOnceAndWhere) {
  Report before = makeRunUnder({{"size", "64x64"}}, {{"sun", "none"}}, {{"camera", "automatic"}});
  before.scenes.push_back(before.scenes[0]);
  before.scenes[1].name = "t";
  Report now = before;
  now.conditions[0].value = "128x128";
  for (SceneResult& scene : now.scenes) scene.conditions[0].value = "30,50,4";
  now.scenes[1].views[0].conditions[0].value = "'Front'";
  const Report report = hold(now, before);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0], "the baseline was made with other settings, so 4 rows are not comparable: size was "
                                "64x64, is 128x128; sun was none, "
                                "is 30,50,4 (scene s, scene t); camera was automatic, is 'Front' (view v of scene t)");
  EXPECT_TRUE(hold(now, now).warnings.empty());
}

TEST(Baseline, ATruthOnEitherSideMakesNoDifference) {
  Report before = makeSampleReportWithTruth();
  before.conditions.back().value = "single scattering"; // what is held against it does not depend on the truth
  for (Report now : {makeSampleReport(), makeSampleReportWithTruth()}) {
    compareWithBaseline(now, before, {"old.json", {}, false});
    EXPECT_TRUE(now.warnings.empty()) << now.warnings[0];
    EXPECT_EQ(now.baseline->error, "");
    for (const FigureChange& change : now.scenes[0].views[0].materials[1].baseline->changes)
      EXPECT_EQ(change.change(), 0) << change.metric;
  }
}

} // namespace
} // namespace parity::report
