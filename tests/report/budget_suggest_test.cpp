// Suggested budgets: the percentile and the margin on known values, files that loadBudgets reads, and what is refused.
#include <cmath>

#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "base/file.h"
#include "base/temp_folder.h"
#include "base/text/text.h"
#include "compare/verdict/budget.h"
#include "compare/verdict/wording.h"
#include "report/budget_suggest.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

// One view of a scene with one material of this mean FLIP.
ObservedRun runOf(double mean, const std::string& material = "a", const std::string& scene = "s") {
  ViewResult view;
  view.name = "v";
  view.whole = makeFigures(0.05, 8000);
  view.materials = {makeMaterial(material, mean, 4000)};
  ObservedRun run;
  run.source = "run.json";
  run.report.scenes.emplace_back().name = scene;
  run.report.scenes[0].views = {view};
  return run;
}

compare::Budgets load(const std::string& text) {
  const base::TempFolder folder;
  base::writeText(folder / "b.toml", text);
  return compare::loadBudgets(folder / "b.toml");
}

compare::Budgets suggest(const std::vector<ObservedRun>& runs, const std::vector<std::string>& figures = {"flip.mean"},
                         double margin = 0.5) {
  return load(suggestBudgets(runs, {margin, figures}).text);
}

const compare::BudgetCheck& checkOf(const compare::Budgets& budgets) { return budgets.materials.at(0).checks.at(0); }

TEST(BudgetSuggest, LimitsAreTheLargestOfFewRunsPlusTheMargin) {
  const compare::Budgets budgets = suggest({runOf(0.10), runOf(0.20), runOf(0.15)});
  EXPECT_NEAR(*checkOf(budgets).warn, 0.30, 1e-9);
  EXPECT_NEAR(*checkOf(budgets).fail, 0.40, 1e-9);
  EXPECT_EQ(budgets.materials[0].reason, "suggested from 3 runs: observed p95 plus a margin of 50 %");
  EXPECT_EQ(budgets.materials[0].material, "a");
  EXPECT_EQ(budgets.materials[0].scene, "s");
  EXPECT_NEAR(*budgets.wholes[0].checks[0].fail, 0.10, 1e-9); // 0.05, twice
}

// Of 1..40 hundredths the one of rank ceil(0.95 * 40) = 38; two outliers do not count.
TEST(BudgetSuggest, OfManyRunsThe95thPercentileCounts) {
  std::vector<ObservedRun> runs;
  for (int i = 40; i >= 1; --i) runs.push_back(runOf(0.01 * i));
  EXPECT_NEAR(*checkOf(suggest(runs, {"flip.mean"}, 0.1)).warn, 0.418, 1e-9);
}

TEST(BudgetSuggest, TheWorstViewOfARunCounts) {
  ObservedRun run = runOf(0.10);
  run.report.scenes[0].views.push_back(runOf(0.20).report.scenes[0].views[0]);
  EXPECT_NEAR(*checkOf(suggest({run, runOf(0.12)})).warn, 0.30, 1e-9);
}

TEST(BudgetSuggest, MoreThanTheDisplayedDigitsIsRoundedAwayFromTheBest) {
  EXPECT_NEAR(*checkOf(suggest({runOf(0.10021)}, {"flip.mean"}, 0)).warn, 0.102, 1e-9); // 0.101 and a step
  EXPECT_NEAR(*checkOf(suggest({runOf(0)}, {"flip.mean"})).warn, 0.001, 1e-9) << "identical: one step is the margin";
  EXPECT_NEAR(*checkOf(suggest({runOf(0)}, {"flip.mean"})).fail, 0.002, 1e-9);
}

TEST(BudgetSuggest, TheMarginIsAShareOfTheErrorWhicheverWayIsBetter) {
  ObservedRun run = runOf(0.10);
  setFigure(run.report.scenes[0].views[0].materials[0].figures, "psnr", 30);
  setFigure(run.report.scenes[0].views[0].materials[0].figures, "ssim.mean", 0.9);
  setFigure(run.report.scenes[0].views[0].materials[0].figures, "bias.ev", -0.2);
  run.report.scenes[0].views[0].whole = {};
  EXPECT_NE(suggestBudgets({run}, {0, {"bias.ev"}}).text.find("bias.ev ±0.20 EV to ±0.20 EV"), std::string::npos);
  const compare::Budgets budgets = suggest({run}, {"psnr", "ssim.mean", "bias.ev"});
  const std::vector<compare::BudgetCheck>& checks = budgets.materials.at(0).checks;
  EXPECT_NEAR(*checks[0].warn, 26.4, 1e-9); // 30 - 20 log10(1.5) = 26.48
  EXPECT_NEAR(*checks[0].fail, 23.9, 1e-9); // 30 - 20 log10(2) = 23.98
  EXPECT_NEAR(*checks[1].warn, 0.85, 1e-9); // 1 - 0.1 * 1.5
  EXPECT_NEAR(*checks[1].fail, 0.80, 1e-9);
  EXPECT_NEAR(*checks[2].warn, 0.30, 1e-9);
  EXPECT_NEAR(*checks[2].fail, 0.40, 1e-9);
}

TEST(BudgetSuggest, WhatWasObservedPassesWhatIsSuggested) {
  ObservedRun run{"sample.json", makeSampleReport()};
  const compare::Budgets budgets = suggest({run}, {"flip.mean", "flip.p95", "rmse"}, 0);
  for (ViewResult& view : run.report.scenes[0].views) {
    judgeWhole(view, budgets, "Lamp");
    for (const compare::CheckResult& check : view.checks)
      EXPECT_EQ(check.verdict, compare::Verdict::pass) << compare::describeCheck(check);
    for (MaterialResult& material : view.materials) {
      judgeMaterial(material, budgets, "Lamp");
      const bool isUnseen = material.figures.pixels == 0;
      if (isUnseen || material.name == "Rivet" || material.name == "Lit panel") continue; // nothing was suggested
      EXPECT_NE(material.rule.origin, "built-in") << material.name;
      for (const compare::CheckResult& check : material.checks)
        EXPECT_EQ(check.verdict, compare::Verdict::pass) << compare::describeCheck(check);
    }
  }
}

// A size and a brightness at which a figure says nothing must not make the limits of a view that shows the material.
TEST(BudgetSuggest, WhatIsTooSmallOrClippedInAViewIsNotLookedAtThere) {
  ObservedRun run = runOf(0.10);
  std::vector<ViewResult>& views = run.report.scenes[0].views;
  for (const compare::Verdict verdict : {compare::Verdict::tooSmall, compare::Verdict::notJudged}) {
    views.resize(1);
    views.push_back(views[0]);
    views[1].name = "far";
    MaterialResult& far = views[1].materials[0];
    far.figures = makeFigures(0.30, 12);
    far.verdict = verdict;
    const SuggestedBudgets suggested = suggestBudgets({run}, {0.5, {"flip.mean"}});
    EXPECT_NEAR(*checkOf(load(suggested.text)).warn, 0.15, 1e-9);
    EXPECT_TRUE(suggested.leftOut.empty()) << suggested.leftOut[0];

    views[0].materials[0] = far;
    const std::vector<std::string> said = {std::string("'a' of scene 's' is ") + nameOf(verdict) + " in run.json"};
    EXPECT_EQ(suggestBudgets({run}, {0.5, {"flip.mean"}}).leftOut, said);
    views[0].materials[0] = runOf(0.10).report.scenes[0].views[0].materials[0];
  }
}

TEST(BudgetSuggest, HostileNamesMatchThemselvesAlone) {
  for (const std::string& raw : hostileNames()) {
    const std::string name = base::cleanUtf8(raw); // as report.json has it
    const compare::Budgets budgets = suggest({runOf(0.1, name, name)});
    EXPECT_EQ(compare::findMaterialRule(budgets, name, name), &budgets.materials[0]) << name;
  }
  const compare::Budgets budgets = suggest({runOf(0.1, "a*[b]?\\\"", "s")});
  EXPECT_EQ(compare::findMaterialRule(budgets, "s", "a*[b]?\\\""), &budgets.materials[0]);
  EXPECT_NE(compare::findMaterialRule(budgets, "s", "aXbY\\\""), &budgets.materials[0]);
}

TEST(BudgetSuggest, SaysWhatItRestsOnAndWhatItLeavesOut) {
  ObservedRun run{"sample.json", makeSampleReport()};
  ObservedRun other = run;
  other.report.version = "0.2.0";
  const std::string text = suggestBudgets({run, other, run}, {}).text;
  for (const char* part : {"# Budgets suggested from 2 runs", "#   sample.json", "With fewer than 20 runs",
                           "# Left out: scene 'Broken' could not be compared in sample.json",
                           "# Left out: no view shows 'Screw' of scene 'Lamp' in sample.json",
                           "# Left out: 'Rivet' of scene 'Lamp' is too small in sample.json",
                           "# Left out: 'Lit panel' of scene 'Lamp' is not judged in sample.json",
                           "# 2 runs: flip.mean 0.270 to 0.270, flip.p95 0.675 to 0.675"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(BudgetSuggest, IdenticalImagesLeaveNoPsnrToLimit) {
  ObservedRun run = runOf(0); // its psnr is infinite
  EXPECT_NE(suggestBudgets({run}, {0.5, {"psnr"}}).text.find("'a' of scene 's' was identical"), std::string::npos);
}

// A run with NaN pixels holds their worst value: its limits would let through what they are to stop.
TEST(BudgetSuggest, WhatHadNonFinitePixelsInAnyRunIsLeftOutAndSaid) {
  ObservedRun broken = runOf(0.9, "a");
  broken.source = "nan.json";
  broken.report.scenes[0].views[0].materials[0].figures.nonFinite = 5;
  broken.report.scenes[0].views[0].materials.push_back(makeMaterial("b", 0.2, 4000));
  for (const std::vector<ObservedRun>& runs : {std::vector{runOf(0.1), broken}, {broken, runOf(0.1)}}) {
    const SuggestedBudgets suggested = suggestBudgets(runs, {0.5, {"flip.mean"}});
    const compare::Budgets budgets = load(suggested.text);
    EXPECT_EQ(budgets.materials.at(0).material, "b");
    const std::string line = "scene s, view v, material a has 5 NaN or infinite pixels in nan.json";
    EXPECT_EQ(suggested.leftOut, std::vector<std::string>{line});
    EXPECT_NE(suggested.text.find("# Left out: " + line + "\n"), std::string::npos);
  }
  broken.report.scenes[0].views[0].materials.pop_back();
  broken.report.scenes[0].views[0].whole = {};
  base::expectError([&] { suggestBudgets({broken}, {}); }, "nan.json", "5 NaN or infinite pixels");
}

TEST(BudgetSuggest, NoLimitIsSuggestedThatNothingCouldBeBeyond) {
  const SuggestedBudgets suggested = suggestBudgets({runOf(0.6, "a"), runOf(0.8, "b")}, {0.5, {"flip.mean"}});
  const compare::Budgets budgets = load(suggested.text); // which refuses such limits
  EXPECT_EQ(budgets.materials.at(0).checks[0].warn, 0.9);
  EXPECT_FALSE(budgets.materials.at(0).checks[0].fail) << "1.2 is none";
  EXPECT_EQ(compare::findMaterialRule(budgets, "s", "b")->origin, "built-in") << "its limits would be 1.2 and 1.6";
  const std::vector<std::string> said = {
      "'a' of scene 's': no 'fail' of flip.mean is suggested, because no value can exceed it (observed: 0.600)",
      "'b' of scene 's': no limit of flip.mean is suggested, because no value can exceed it (observed: 0.800)"};
  EXPECT_EQ(suggested.leftOut, said);
}

TEST(BudgetSuggest, TheSameReportTwiceIsOneRun) {
  ObservedRun copy = runOf(0.1);
  copy.source = "copy.json";
  const SuggestedBudgets suggested = suggestBudgets({runOf(0.1), copy}, {0.5, {"flip.mean"}});
  EXPECT_EQ(suggested.leftOut, std::vector<std::string>{"copy.json is the same run as run.json, so it counts once"});
  EXPECT_NE(suggested.text.find("# Budgets suggested from 1 run\n"), std::string::npos);
}

TEST(BudgetSuggest, RefusesWhatItCannotRestOn) {
  base::expectError([] { suggestBudgets({}, {}); }, "budget suggest", "no report was given");
  base::expectError([] { suggestBudgets({{"r.json", Report{}}}, {}); }, "r.json", "nothing to suggest");
  base::expectError([] { suggestBudgets({runOf(0.1)}, {0.5, {"maxabs"}}); }, "run.json", "maxabs was not measured");
  base::expectError(
      [] {
        suggestBudgets({runOf(0.1)}, {0.5, {"flip.meen"}});
      },
      "budget suggest", "flip.mean", base::ExitCode::usage);
  base::expectError(
      [] {
        suggestBudgets({runOf(0.1)}, {0.5, {}});
      },
      "budget suggest", "no figure", base::ExitCode::usage);
  base::expectError([] { suggestBudgets({runOf(0.1)}, {NAN, {"rmse"}}); }, "margin", "0 to 10", base::ExitCode::usage);
  ObservedRun broken = runOf(0.1);
  setFigure(broken.report.scenes[0].views[0].materials[0].figures, "flip.mean", NAN);
  base::expectError([&] { suggestBudgets({broken}, {}); }, "scene s, view v, material a", "is not a number");
}

} // namespace
} // namespace parity::report
