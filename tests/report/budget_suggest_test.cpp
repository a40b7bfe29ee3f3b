// Suggested budgets: the percentile and the margin on known values, files that loadBudgets reads, and what is refused.
#include <cmath>

#include <set>

#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "base/file.h"
#include "base/temp_folder.h"
#include "base/text/text.h"
#include "compare/verdict/budget.h"
#include "compare/verdict/wording.h"
#include "report/baseline.h"
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
  EXPECT_EQ(budgets.materials[0].scene, "*");
  EXPECT_NEAR(*budgets.wholes[0].checks[0].fail, 0.10, 1e-9); // 0.05, twice
}

// Of 1..40 hundredths the one of rank ceil(0.95 * 40) = 38; two outliers do not count.
TEST(BudgetSuggest, OfManyRunsThe95thPercentileCounts) {
  std::vector<ObservedRun> runs;
  for (int i = 40; i >= 1; --i) runs.push_back(runOf(0.01 * i));
  EXPECT_NEAR(*checkOf(suggest(runs, {"flip.mean"}, 0.1)).warn, 0.418, 1e-9);
  EXPECT_NEAR(*checkOf(suggest(runs, {"flip.mean"}, 0.1)).fail, 0.456, 1e-9);
  EXPECT_NEAR(*checkOf(suggest(runs, {"flip.mean"}, 0)).fail, 0.402, 1e-9) << "an outlier warns, but never fails";
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

// Judges the run again by the text, as an unchanged run is.
Report rerun(Report report, const std::string& text) {
  const compare::Budgets budgets = load(text);
  for (SceneResult& scene : report.scenes)
    for (ViewResult& view : scene.views) {
      judgeWhole(view, budgets, scene.name);
      for (MaterialResult& material : view.materials) judgeMaterial(material, budgets, scene.name);
    }
  if (std::string line = describeUnusedRules(budgets, report); !line.empty()) report.warnings.push_back(line);
  settleVerdicts(report);
  return report;
}

void expectPass(const Report& report, const std::string& text) {
  EXPECT_EQ(exitCode(report, true), 0) << headline(report) << "\n" << text << toTable(report, {}, {.all = true});
}

// A scene with one of everything that is no pass, beside one that is well.
ObservedRun runOfAll() {
  ObservedRun run{"all.json", makeSampleReport()};
  run.report.scenes.erase(run.report.scenes.begin() + 1); // it could not be compared
  ViewResult& front = run.report.scenes[0].views[0];
  front.materials[0].figures.clippedBlack = 0.1;
  front.whole.clippedWhite = 0.06;
  MaterialResult broken = makeMaterial("NaN", 1, 500);
  broken.figures.nonFinite = 7;
  MaterialResult bright = makeMaterial("No limit", 0.95, 500);
  for (ViewResult& view : run.report.scenes[0].views) {
    view.materials.push_back(broken);
    view.materials.push_back(bright);
  }
  run.report.scenes[0].views[1].whole = {}; // shows nothing
  run.report.scenes.push_back(runOf(0.1).report.scenes[0]);
  return run;
}

TEST(BudgetSuggest, AnUnchangedRunPassesWithoutAWarning) {
  const ObservedRun run = runOfAll();
  ASSERT_NE(exitCode(rerun(run.report, "[[material]]\nname = \"*\"\npreset = \"default\"\n"), false), 0);
  for (const bool perScene : {false, true})
    for (const double margin : {0.0, 0.25, 3.0})
      for (const std::vector<std::string>& figures :
           {std::vector<std::string>{"flip.mean", "flip.p95"}, {"flip.max"}, {"psnr"}, {"bias.ev", "rmse"}}) {
        const SuggestedBudgets suggested = suggestBudgets({run}, {margin, figures, perScene});
        EXPECT_TRUE(suggested.errors.empty());
        expectPass(rerun(run.report, suggested.text), suggested.text);
      }
}

TEST(BudgetSuggest, EachOfSeveralRunsPassesAlsoAnOutlier) {
  std::vector<ObservedRun> runs;
  for (int i = 1; i <= 40; ++i) runs.push_back(runOf(i == 40 ? 0.9 : 0.001 * i));
  for (const std::string figure : {"flip.mean", "psnr", "flip.max"}) {
    const std::string text = suggestBudgets(runs, {0.1, {figure}}).text;
    for (const ObservedRun& run : runs) EXPECT_EQ(exitCode(rerun(run.report, text), false), 0) << text;
  }
}

// bias.ev is not judged where it is too dark, and nothing else is limited.
TEST(BudgetSuggest, WhatIsTooDarkForItsOnlyLimitIsAccepted) {
  ObservedRun run = runOf(0.1);
  ViewResult dark = run.report.scenes[0].views[0];
  dark.name = "dark";
  for (compare::Figures* figures : {&dark.whole, &dark.materials[0].figures})
    figures->referenceLuminance = figures->testLuminance = 0.0001;
  run.report.scenes[0].views.push_back(dark);
  const std::string text = suggestBudgets({run}, {0.25, {"bias.ev"}}).text;
  EXPECT_NE(text.find("accept = [\"not judged\"]"), std::string::npos) << text;
  expectPass(rerun(run.report, text), text);
}

TEST(BudgetSuggest, WithRegressAnUnchangedRunPassesAgainstAnyOfTheRuns) {
  std::vector<ObservedRun> runs = {runOfAll(), runOfAll(), runOfAll()};
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (SceneResult& scene : runs[i].report.scenes)
      for (ViewResult& view : scene.views)
        for (MaterialResult& material : view.materials)
          if (material.figures.find("flip.mean"))
            setFigure(material.figures, "flip.mean",
                      *material.figures.find("flip.mean") * (1 - 0.1 * static_cast<double>(i)));
  const SuggestedBudgets suggested = suggestBudgets(runs, {0, {"flip.mean", "bias.ev"}, false, true});
  EXPECT_EQ(suggested.text.find("checks"), std::string::npos);
  for (const ObservedRun& run : runs)
    for (const ObservedRun& before : runs) {
      Report report = rerun(run.report, suggested.text);
      compareWithBaseline(report, before.report, {"old", {}, false});
      expectPass(report, suggested.text);
    }
  Report worse = runs[0].report;
  setFigure(worse.scenes[1].views[0].materials[0].figures, "flip.mean", 0.2);
  worse = rerun(worse, suggested.text);
  compareWithBaseline(worse, runs[0].report, {"old", {}, false});
  EXPECT_EQ(exitCode(worse, false), 2);
}

TEST(BudgetSuggest, ScenesShareOneRuleAMaterialWithTheWorst) {
  ObservedRun run = runOf(0.10, "a", "x");
  run.report.scenes.push_back(runOf(0.20, "a", "y").report.scenes[0]);
  run.report.scenes.push_back(runOf(0.05, "b", "y").report.scenes[0]);
  run.report.scenes.back().name = "z";
  const std::string text = suggestBudgets({run}, {0.5, {"flip.mean"}}).text;
  const compare::Budgets shared = load(text);
  ASSERT_EQ(shared.materials.size(), 3u) << "a, b, and the built-in one\n" << text;
  ASSERT_EQ(shared.wholes.size(), 2u);
  EXPECT_NEAR(*checkOf(shared).warn, 0.30, 1e-9);
  EXPECT_NE(text.find("# 1 run: flip.mean 0.100 ('x') to 0.200 ('y')\n"), std::string::npos) << text;
  const compare::Budgets own = load(suggestBudgets({run}, {0.5, {"flip.mean"}, true}).text);
  ASSERT_EQ(own.materials.size(), 4u);
  ASSERT_EQ(own.wholes.size(), 4u);
  EXPECT_NEAR(*compare::findMaterialRule(own, "x", "a")->checks[0].warn, 0.15, 1e-9);
}

// NaN, and what has no limit at all, is accepted of its own scene alone.
TEST(BudgetSuggest, WhatNoLimitHoldsLoosensNoOtherScene) {
  ObservedRun run = runOf(0.95, "a", "x");
  run.report.scenes.push_back(runOf(0.10, "a", "y").report.scenes[0]);
  run.report.scenes.push_back(runOf(0.10, "a", "z").report.scenes[0]);
  run.report.scenes[2].views[0].materials[0].figures.nonFinite = 3;
  const SuggestedBudgets suggested = suggestBudgets({run}, {0.5, {"flip.mean"}});
  const compare::Budgets budgets = load(suggested.text);
  EXPECT_TRUE(compare::findMaterialRule(budgets, "x", "a")->checks.empty());
  EXPECT_NEAR(*compare::findMaterialRule(budgets, "y", "a")->checks[0].warn, 0.15, 1e-9);
  EXPECT_FALSE(compare::findMaterialRule(budgets, "y", "a")->maxNonFinite);
  EXPECT_EQ(compare::findMaterialRule(budgets, "z", "a")->maxNonFinite, std::uint64_t{3});
  expectPass(rerun(run.report, suggested.text), suggested.text);
  ++run.report.scenes[2].views[0].materials[0].figures.nonFinite;
  EXPECT_EQ(exitCode(rerun(run.report, suggested.text), false), 2) << "one more than was accepted";
}

// The worst of each figure is another scene's, and at the end of its range: together they have no limit.
TEST(BudgetSuggest, ScenesThatHaveNoLimitTogetherHaveTheirOwn) {
  ObservedRun run = runOf(0.1, "a", "one"), other = runOf(0.1, "a", "two");
  setFigure(run.report.scenes[0].views[0].materials[0].figures, "flip.max", 0.95);
  setFigure(run.report.scenes[0].views[0].materials[0].figures, "flip.fraction_over(0.1)", 0.01);
  setFigure(other.report.scenes[0].views[0].materials[0].figures, "flip.max", 0.30);
  setFigure(other.report.scenes[0].views[0].materials[0].figures, "flip.fraction_over(0.1)", 0.90);
  for (ObservedRun* each : {&run, &other}) {
    setFigure(each->report.scenes[0].views[0].whole, "flip.max", 0.5);
    setFigure(each->report.scenes[0].views[0].whole, "flip.fraction_over(0.1)", 0.1);
  }
  run.report.scenes.push_back(other.report.scenes[0]);
  const compare::Budgets budgets = load(suggestBudgets({run}, {0.25, {"flip.max", "flip.fraction_over(0.1)"}}).text);
  std::set<std::string> scenes;
  for (const compare::BudgetRule& rule : budgets.materials)
    if (rule.material == "a") {
      scenes.insert(rule.scene);
      EXPECT_FALSE(rule.checks.empty()) << rule.scene;
      EXPECT_TRUE(rule.accept.empty()) << rule.scene;
    }
  EXPECT_EQ(scenes, (std::set<std::string>{"one", "two"}));
}

TEST(BudgetSuggest, WhatIsIdenticalByAnotherFigureIsSo) {
  ObservedRun run = runOf(0);
  for (compare::Figures* each :
       {&run.report.scenes[0].views[0].materials[0].figures, &run.report.scenes[0].views[0].whole}) {
    std::erase_if(each->values, [](const compare::Figure& figure) { return figure.name != "flip.mean"; });
    setFigure(*each, "psnr", INFINITY);
  }
  EXPECT_EQ(load(suggestBudgets({run}, {0.25, {"psnr"}}).text).materials.at(0).preset, "identical");
}

TEST(BudgetSuggest, ErrorsAreNeverAcceptedAndSaid) {
  ObservedRun run{"sample.json", makeSampleReport()};
  SuggestedBudgets suggested = suggestBudgets({run}, {});
  const std::string broken = "scene 'Broken' could not be compared in sample.json, and no rule can accept that";
  EXPECT_EQ(suggested.errors, std::vector<std::string>{broken});
  EXPECT_NE(suggested.text.find("# AN UNCHANGED RUN IS AN ERROR: " + broken), std::string::npos);
  EXPECT_EQ(exitCode(rerun(run.report, suggested.text), false), 4);
  ObservedRun later = run;
  later.source = "later.json";
  later.report.scenes[1] = runOf(0.1).report.scenes[0];
  later.report.scenes[1].name = "Broken";
  suggested = suggestBudgets({run, later}, {});
  EXPECT_TRUE(suggested.errors.empty()) << "another run compares it";
  EXPECT_EQ(suggested.notes.at(0), "scene 'Broken' could not be compared in sample.json");

  ObservedRun noTruth = runOf(0.1);
  noTruth.report.scenes[0].views[0].truth.emplace().figures.nonFinite = 2;
  suggested = suggestBudgets({noTruth}, {});
  ASSERT_EQ(suggested.errors.size(), 1u);
  EXPECT_NE(suggested.errors[0].find("pixels of the truth are NaN"), std::string::npos);
  ObservedRun unsound = runOf(0.1);
  setFigure(unsound.report.scenes[0].views[0].materials[0].figures, "bias.ev", INFINITY);
  suggested = suggestBudgets({unsound}, {});
  ASSERT_EQ(suggested.errors.size(), 1u);
  EXPECT_NE(suggested.errors[0].find("bias.ev is not a number"), std::string::npos);
}

// A size at which a figure says nothing must not make the limits of a view that shows the material. What is clipped for
// the most part does: limits judge it there, too.
TEST(BudgetSuggest, WhatIsTooSmallInAViewIsNotLookedAtThere) {
  ObservedRun run = runOf(0.10);
  std::vector<ViewResult>& views = run.report.scenes[0].views;
  views.push_back(views[0]);
  views[1].name = "far";
  views[1].materials[0].figures = makeFigures(0.30, 12);
  SuggestedBudgets suggested = suggestBudgets({run}, {0.5, {"flip.mean"}});
  EXPECT_NEAR(*checkOf(load(suggested.text)).warn, 0.15, 1e-9);
  EXPECT_TRUE(suggested.accepted.empty()) << suggested.accepted[0];
  EXPECT_TRUE(suggested.faults.empty());
  views[1].materials[0].figures = makeFigures(0.30, 4000);
  views[1].materials[0].figures.clippedWhite = 0.8;
  suggested = suggestBudgets({run}, {0.5, {"flip.mean"}});
  EXPECT_NEAR(*checkOf(load(suggested.text)).warn, 0.45, 1e-9);
  EXPECT_EQ(
      suggested.accepted,
      std::vector<std::string>{"'a' of scene 's': up to 81.0 % of its pixels are black or white in both pictures"});
  expectPass(rerun(run.report, suggested.text), suggested.text);
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

TEST(BudgetSuggest, SaysWhatItRestsOnAndWhatItAccepts) {
  ObservedRun run{"sample.json", makeSampleReport()};
  ObservedRun other = run;
  other.report.version = "0.2.0";
  const std::string text = suggestBudgets({run, other, run}, {}).text;
  for (const char* part :
       {"# Budgets suggested from 2 runs", "#   sample.json", "With fewer than 20 runs",
        "# Accepted: no view shows it\n[[material]]\nname = \"Screw\"\nreason = \"accepted as observed in 2 runs: no "
        "view shows it\"\naccept = [\"not seen\"]\npreset = \"default\"\n",
        "# Accepted: fewer than 64 pixels show it\n[[material]]\nname = \"Rivet\"\n",
        "# Accepted: base layer only: parity does not model sheen\n",
        "\n# 2 runs: flip.mean 0.270 to 0.270, flip.p95 0.675 to 0.675\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(BudgetSuggest, WhatWasIdenticalStaysSoWherePsnrHasNoLimit) {
  const ObservedRun run = runOf(0); // its psnr is infinite
  const std::string text = suggestBudgets({run}, {0.5, {"psnr"}}).text;
  EXPECT_EQ(load(text).materials.at(0).preset, "identical");
  expectPass(rerun(run.report, text), text);
  EXPECT_EQ(exitCode(rerun(runOf(0.01).report, text), false), 2);
}

// A run with NaN pixels holds their worst value: its limits would let through what they are to stop.
TEST(BudgetSuggest, NonFinitePixelsMakeNoLimitsAndAreAcceptedLoudly) {
  ObservedRun broken = runOf(0.9, "a"), sound = runOf(0.1, "a");
  broken.source = "nan.json";
  broken.report.scenes[0].views[0].materials[0].figures.nonFinite = 5;
  const std::string nothing = suggestBudgets({broken, sound}, {0.5, {"flip.mean"}}).text;
  EXPECT_EQ(exitCode(rerun(broken.report, nothing), false), 4) << "nothing else was compared in that run";
  for (ObservedRun* each : {&broken, &sound})
    each->report.scenes[0].views[0].materials.push_back(makeMaterial("well", 0.1, 4000));
  for (const std::vector<ObservedRun>& runs : {std::vector{sound, broken}, {broken, sound}}) {
    const SuggestedBudgets suggested = suggestBudgets(runs, {0.5, {"flip.mean"}});
    EXPECT_NEAR(*checkOf(load(suggested.text)).warn, 0.15, 1e-9);
    ASSERT_EQ(suggested.accepted.size(), 1u);
    EXPECT_EQ(suggested.faults, suggested.accepted) << "a fault, too";
    EXPECT_EQ(suggested.accepted[0], "'a' of scene 's': up to 5 pixels are NaN OR INFINITE in a view, which is a fault "
                                     "of a renderer and not a matter of limits");
    EXPECT_NE(suggested.text.find("# Accepted: up to 5 pixels are NaN OR INFINITE"), std::string::npos);
    for (const ObservedRun& run : runs) {
      const Report again = rerun(run.report, suggested.text);
      expectPass(again, suggested.text);
      EXPECT_EQ(headline(again).find("accepted exceptions for 1 material") != std::string::npos,
                run.source == "nan.json");
    }
  }
  const std::string alone = suggestBudgets({broken, runOf(0.1, "b")}, {}).text;
  EXPECT_EQ(load(alone).materials.at(0).preset, "default") << "once they are gone, the built-in limits judge";
}

TEST(BudgetSuggest, NoLimitIsSuggestedThatNothingCouldBeBeyond) {
  const SuggestedBudgets suggested = suggestBudgets({runOf(0.6, "a"), runOf(0.8, "b")}, {0.5, {"flip.mean"}});
  const compare::Budgets budgets = load(suggested.text); // which refuses such limits
  const compare::BudgetRule& warnsAlone = *compare::findMaterialRule(budgets, "s", "a");
  EXPECT_EQ(warnsAlone.checks.at(0).warn, 0.9);
  EXPECT_FALSE(warnsAlone.checks[0].fail) << "1.2 is none";
  const compare::BudgetRule& none = *compare::findMaterialRule(budgets, "s", "b");
  EXPECT_EQ(none.accept, std::vector{compare::Accept::noLimit}) << "its limits would be 1.2 and 1.6";
  const std::vector<std::string> said = {
      "'b' of scene 's': no limit of flip.mean is suggested, because no value can exceed it (observed: 0.800)",
      "'a' of scene 's': no 'fail' of flip.mean is suggested, because no value can exceed it (observed: 0.600)"};
  EXPECT_EQ(suggested.notes, said);
  EXPECT_EQ(suggested.accepted, std::vector<std::string>{"'b' of scene 's': nothing limits it, because no value can "
                                                         "exceed a limit"});
}

TEST(BudgetSuggest, TheSameReportTwiceIsOneRun) {
  ObservedRun copy = runOf(0.1);
  copy.source = "copy.json";
  const SuggestedBudgets suggested = suggestBudgets({runOf(0.1), copy}, {0.5, {"flip.mean"}});
  EXPECT_EQ(suggested.notes, std::vector<std::string>{"copy.json is the same run as run.json, so it counts once"});
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
