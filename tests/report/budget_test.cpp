// Budgets: limits, rules, and that nothing passes that was not measured.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "compare/flip/flip.h"
#include "compare/metrics/measure.h"
#include "compare/pooling/region.h"
#include "compare/verdict/budget.h"
#include "compare/verdict/wording.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

compare::BudgetCheck checkOf(const std::string& figure, std::optional<double> warn, std::optional<double> fail) {
  return {compare::requireStatistic(figure, "test"), warn, fail};
}

compare::BudgetRule ruleOf(std::vector<compare::BudgetCheck> checks) {
  compare::BudgetRule rule;
  rule.checks = std::move(checks);
  return rule;
}

compare::Verdict verdictAt(const compare::BudgetCheck& check, double value) {
  compare::Figures figures = makeFigures(0.1, 4000);
  setFigure(figures, check.statistic.name, value);
  return compare::runChecks(ruleOf({check}), figures).at(0).verdict;
}

TEST(Budget, BeyondALimitIsStrictlyBeyondIt) {
  const compare::BudgetCheck check = checkOf("flip.mean", 0.1, 0.2);
  EXPECT_EQ(verdictAt(check, 0), compare::Verdict::pass);
  EXPECT_EQ(verdictAt(check, 0.1), compare::Verdict::pass);
  EXPECT_EQ(verdictAt(check, std::nextafter(0.1, 1)), compare::Verdict::warn);
  EXPECT_EQ(verdictAt(check, 0.2), compare::Verdict::warn);
  EXPECT_EQ(verdictAt(check, std::nextafter(0.2, 1)), compare::Verdict::fail);
}

TEST(Budget, PsnrIsALowerBoundAndIdenticalImagesPassAny) {
  const compare::BudgetCheck check = checkOf("psnr", 32, 28);
  EXPECT_EQ(verdictAt(check, 40), compare::Verdict::pass);
  EXPECT_EQ(verdictAt(check, 32), compare::Verdict::pass);
  EXPECT_EQ(verdictAt(check, 31.9), compare::Verdict::warn);
  EXPECT_EQ(verdictAt(check, 27.9), compare::Verdict::fail);
  EXPECT_EQ(verdictAt(check, kInfinity), compare::Verdict::pass);
}

TEST(Budget, EitherLimitMayStandAlone) {
  EXPECT_EQ(verdictAt(checkOf("rmse", std::nullopt, 0.2), 0.15), compare::Verdict::pass);
  EXPECT_EQ(verdictAt(checkOf("rmse", std::nullopt, 0.2), 0.25), compare::Verdict::fail);
  EXPECT_EQ(verdictAt(checkOf("rmse", 0.1, std::nullopt), 0.9), compare::Verdict::warn);
}

TEST(Budget, ASignedFigureIsBoundedOnEitherSide) {
  const compare::BudgetCheck check = checkOf("bias.ev", 0.1, 0.3);
  for (const double sign : {-1., 1.}) {
    EXPECT_EQ(verdictAt(check, sign * 0.1), compare::Verdict::pass);
    EXPECT_EQ(verdictAt(check, sign * 0.2), compare::Verdict::warn);
    EXPECT_EQ(verdictAt(check, sign * 0.4), compare::Verdict::fail);
  }
}

TEST(Budget, NotANumberIsAnErrorForEveryFigure) {
  for (std::string name : compare::knownStatistics()) {
    if (name.ends_with("(X)")) name.replace(name.size() - 2, 1, "0.1");
    EXPECT_EQ(verdictAt(checkOf(name, 0.5, 0.5), kNan), compare::Verdict::error) << name;
  }
}

TEST(Budget, AFigureThatWasNotMeasuredIsAnErrorInWords) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  compare::Budgets budgets;
  budgets.materials = {ruleOf({checkOf("flip.mean", 0.1, 0.2), checkOf("flip.fraction_over(0.1)", 0.1, 0.2)})};
  judgeMaterial(material, budgets, "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::error);
  EXPECT_EQ(material.reason, "share of pixels with FLIP over 0.1: not measured");
  EXPECT_EQ(material.checks.at(0).verdict, compare::Verdict::pass);
}

TEST(Budget, NamesEachFigureThatARunHasToMeasureOnce) {
  compare::Budgets budgets = compare::defaultBudgets();
  budgets.materials[0].checks.push_back(checkOf("maxabs", 0.1, 0.2));
  budgets.materials[0].regress.push_back(checkOf("flip.mean", 0.1, 0.2));
  budgets.materials[0].regress.push_back(checkOf("psnr", 1, 2));
  const std::vector<std::string> expected = {"flip.mean", "flip.p95", "bias.ev", "maxabs", "psnr"};
  EXPECT_EQ(compare::requiredStatistics(budgets), expected);
}

TEST(Budget, TheStrictPresetIsHalfOfTheDefault) {
  const auto& presets = compare::builtInPresets();
  ASSERT_EQ(presets.size(), 3u);
  const auto expectHalf = [](const std::vector<compare::BudgetCheck>& whole,
                             const std::vector<compare::BudgetCheck>& half) {
    ASSERT_EQ(whole.size(), half.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(half[i].statistic.name, whole[i].statistic.name);
      EXPECT_DOUBLE_EQ(*half[i].warn, *whole[i].warn / 2);
      EXPECT_DOUBLE_EQ(*half[i].fail, *whole[i].fail / 2);
    }
  };
  expectHalf(presets[0].materials, presets[1].materials);
  expectHalf(presets[0].wholes, presets[1].wholes);
  // budget.h says what these mean.
  EXPECT_EQ(presets[0].materials[0].warn, 0.10);
  EXPECT_EQ(presets[0].materials[0].fail, 0.20);
  EXPECT_EQ(presets[0].materials[1].warn, 0.30);
  EXPECT_EQ(presets[0].materials[1].fail, 0.50);
  EXPECT_EQ(presets[0].wholes[0].warn, 0.08);
  EXPECT_EQ(presets[0].wholes[0].fail, 0.16);
  for (const std::vector<compare::BudgetCheck>* checks : {&presets[0].materials, &presets[0].wholes}) {
    ASSERT_EQ(checks->size(), 3u);
    EXPECT_EQ(checks->at(2).statistic.name, "bias.ev");
    EXPECT_EQ(checks->at(2).warn, 0.25);
    EXPECT_EQ(checks->at(2).fail, 0.5);
  }
}

TEST(Budget, ThePresetIdenticalPassesNothingButIdentity) {
  const compare::BudgetPreset& identical = compare::builtInPresets().at(2);
  EXPECT_EQ(verdictAt(identical.materials.at(0), 0), compare::Verdict::pass);
  EXPECT_EQ(verdictAt(identical.materials.at(0), 1e-6), compare::Verdict::fail);
}

// Light before it is clipped: what white on white hides from FLIP.
TEST(Budget, BuiltInLimitsJudgeTheExposureToo) {
  for (const std::vector<compare::BudgetCheck>* checks :
       {&compare::defaultBudgets().materials[0].checks, &compare::defaultBudgets().wholes[0].checks}) {
    const auto ev =
        std::ranges::find(*checks, "bias.ev", [](const compare::BudgetCheck& check) { return check.statistic.name; });
    ASSERT_NE(ev, checks->end());
    for (const double sign : {-1., 1.}) {
      EXPECT_EQ(verdictAt(*ev, sign * 0.24), compare::Verdict::pass) << sign;
      EXPECT_EQ(verdictAt(*ev, sign * 0.26), compare::Verdict::warn) << sign;
      EXPECT_EQ(verdictAt(*ev, sign * 0.50), compare::Verdict::warn) << sign;
      EXPECT_EQ(verdictAt(*ev, sign * 0.51), compare::Verdict::fail) << sign;
    }
  }
  MaterialResult material = makeMaterial("x", 0, 4000, std::exp2(-0.51)); // no FLIP at all
  judgeMaterial(material, compare::defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::fail);
  EXPECT_EQ(material.reason, "mean exposure difference -0.51 EV is beyond ±0.50 EV");
}

// Of light that the display hardly shows, a ratio says nothing.
TEST(Budget, AnExposureBetweenTwoNearlyBlackPicturesIsNotJudgedAndSaysWhy) {
  MaterialResult material = makeMaterial("x", 0.01, 4000);
  setFigure(material.figures, "bias.ev", 2);
  material.figures.referenceLuminance = 0.0005;
  material.figures.testLuminance = std::nextafter(compare::kLeastLuminance, 0);
  judgeMaterial(material, compare::defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::pass) << material.reason;
  const auto ev = std::ranges::find(material.checks, "bias.ev", &compare::CheckResult::metric);
  ASSERT_NE(ev, material.checks.end());
  EXPECT_FALSE(ev->judged());
  EXPECT_EQ(ev->value, 2) << "the figure is told all the same";
  EXPECT_EQ(ev->unjudged,
            "mean luminance is below 0.002 in both pictures, which is too dark to measure a difference of exposure");
  EXPECT_EQ(compare::describeCheck(*ev),
            "mean exposure difference +2.00 EV is not judged: mean luminance is below 0.002 in both pictures, which is "
            "too dark to measure a difference of exposure");

  setFigure(material.figures, "flip.mean", 0.15);
  judgeMaterial(material, compare::defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::warn) << "what is judged is judged";
  EXPECT_EQ(material.reason, "mean FLIP 0.150 is above 0.100");
}

TEST(Budget, DarknessOfOnePictureHidesNoExposure) {
  for (const auto& [reference, test] : {std::pair{0.0, 0.1}, {0.1, 0.0}, {0.0005, compare::kLeastLuminance}}) {
    MaterialResult material = makeMaterial("x", 0.01, 4000);
    setFigure(material.figures, "bias.ev", reference < test ? 2 : -2);
    material.figures.referenceLuminance = reference;
    material.figures.testLuminance = test;
    judgeMaterial(material, compare::defaultBudgets(), "scene");
    EXPECT_EQ(material.verdict, compare::Verdict::fail) << reference << " " << test;
  }
}

TEST(Budget, ABudgetOfExposureAloneJudgesNothingInTheDarkAndWarns) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  compare::Budgets budgets;
  budgets.materials = {ruleOf({checkOf("bias.ev", 0.25, 0.5)})};
  material.figures.referenceLuminance = material.figures.testLuminance = 0.001;
  judgeMaterial(material, budgets, "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::warn);
  EXPECT_EQ(material.reason.find("no check of its budget could be judged: mean exposure difference "), 0u)
      << material.reason;
  setFigure(material.figures, "bias.ev", kNan);
  judgeMaterial(material, budgets, "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::error) << "what is not a number is one in the dark too";
}

TEST(Budget, TheFirstRuleThatMatchesJudges) {
  compare::Budgets budgets;
  compare::BudgetRule hero = ruleOf({checkOf("flip.mean", 0.01, 0.02)});
  hero.material = "Hero*";
  hero.scene = "Title*";
  hero.owner = "characters";
  compare::BudgetRule loose = ruleOf({checkOf("flip.mean", 0.8, 0.9)});
  loose.material = "Hero*";
  budgets.materials = {hero, loose};
  EXPECT_EQ(compare::findMaterialRule(budgets, "Title screen", "Hero face"), &budgets.materials[0]);
  EXPECT_EQ(compare::findMaterialRule(budgets, "Level 1", "Hero face"), &budgets.materials[1]);
  EXPECT_EQ(compare::findMaterialRule(budgets, "Level 1", "hero face"), nullptr);

  MaterialResult material = makeMaterial("Hero face", 0.1, 4000);
  judgeMaterial(material, budgets, "Title screen");
  EXPECT_EQ(material.verdict, compare::Verdict::fail);
  EXPECT_EQ(material.rule.owner, "characters");
  EXPECT_EQ(material.reason, "mean FLIP 0.100 is above 0.020");
  judgeMaterial(material, budgets, "Level 1");
  EXPECT_EQ(material.verdict, compare::Verdict::pass);
  EXPECT_EQ(material.rule.owner, "");
  EXPECT_EQ(material.reason, "");
}

TEST(Budget, NoRuleThatMatchesIsAnErrorNotAPass) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  judgeMaterial(material, compare::Budgets{}, "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::error);
  EXPECT_EQ(material.reason, "no budget check applies");
}

TEST(Budget, NonFinitePixelsFailInWordsWhateverTheFiguresSay) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  material.figures.nonFinite = 3;
  judgeMaterial(material, compare::defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::fail);
  EXPECT_EQ(material.reason, "3 of 4000 pixels are NaN or infinite in one of the two renders");
}

TEST(Budget, AFigureThatNoCheckLooksAtMayNotBeNanEither) {
  for (double compare::Figures::*figure :
       {&compare::Figures::referenceLuma, &compare::Figures::testLuma, &compare::Figures::referenceLuminance,
        &compare::Figures::testLuminance, &compare::Figures::clippedBlack, &compare::Figures::clippedWhite}) {
    MaterialResult material = makeMaterial("x", 0, 4000);
    material.figures.*figure = kNan;
    judgeMaterial(material, compare::defaultBudgets(), "scene");
    EXPECT_EQ(material.verdict, compare::Verdict::error);
    EXPECT_EQ(material.reason.find("a figure is not a number: "), 0u) << material.reason;
  }
}

TEST(Budget, OnlyWhatIsBetterTheMoreOfItMayBeInfinite) {
  MaterialResult material = makeMaterial("x", 0, 4000); // its psnr is infinite
  judgeMaterial(material, compare::defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::pass);
  setFigure(material.figures, "rmse", kInfinity);
  judgeMaterial(material, compare::defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::error);
  EXPECT_EQ(material.reason, "a figure is not a number: rmse");
}

TEST(Budget, ARegionOfWhichNothingWasMeasuredIsAnError) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  material.figures.values.clear();
  judgeMaterial(material, compare::Budgets{}, "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::error);
  EXPECT_EQ(material.reason, "no figure was measured");
}

TEST(Budget, ARuleThatJudgesNothingIsSaidInWords) {
  Report report = makeSampleReport();
  compare::Budgets budgets = compare::defaultBudgets();
  EXPECT_EQ(describeUnusedRules(budgets, report), "");
  compare::BudgetRule misspelt = budgets.materials[0];
  misspelt.material = "Glasss";
  misspelt.scene = "Lamp";
  misspelt.file = "folder/b.toml";
  misspelt.line = 3;
  compare::BudgetRule used = misspelt;
  used.material = "Glass";
  used.line = 7;
  compare::BudgetRule elsewhere = misspelt;
  elsewhere.scene = "Broken"; // could not be compared: nobody knows
  elsewhere.line = 9;
  budgets.materials = {misspelt, used, elsewhere};
  compare::BudgetRule whole = misspelt;
  whole.scene = "Lump";
  whole.line = 12;
  budgets.wholes = {whole};
  for (ViewResult& view : report.scenes[0].views)
    for (MaterialResult& material : view.materials) judgeMaterial(material, budgets, "Lamp");
  EXPECT_EQ(describeUnusedRules(budgets, report), "b.toml: 2 rules judge nothing in this run: line 3 ('Glasss' of "
                                                  "scenes 'Lamp'), line 12 (whole images of scenes 'Lump')");
}

TEST(Budget, AMaterialThatHasToBeSeenAndThatNoSceneHasIsLost) {
  const Report report = makeSampleReport();
  std::vector<const SceneResult*> scenes = {&report.scenes[0]};
  compare::BudgetRule rule = compare::defaultBudgets().materials[0];
  rule.material = "Her?";
  rule.requireSeen = true;
  rule.origin = "b.toml, line 3";
  compare::Budgets budgets;
  budgets.materials = {rule};
  ASSERT_EQ(findLost(budgets, scenes).size(), 1u);
  EXPECT_EQ(findLost(budgets, scenes)[0].verdict, compare::Verdict::fail);
  EXPECT_EQ(findLost(budgets, scenes)[0].reason,
            "b.toml, line 3: require_seen requires material 'Her?', but scene 'Lamp' has no such material");
  budgets.materials[0].requireSeen = false;
  EXPECT_TRUE(findLost(budgets, scenes).empty());
  budgets.materials[0].requireSeen = true;
  budgets.materials[0].scene = "Lump";
  EXPECT_TRUE(findLost(budgets, scenes).empty()) << "of a scene that this run does not show nothing is known";
  budgets.materials[0].scene = "*";
  budgets.materials[0].material = "Gl*";
  EXPECT_TRUE(findLost(budgets, scenes).empty()) << "it is there, whether or not another rule judges it";
  budgets.materials[0].material = "Her?";
  scenes.push_back(&report.scenes[1]);
  EXPECT_TRUE(findLost(budgets, scenes).empty()) << "a scene that failed may have it";
  scenes[1] = &report.scenes[0];
  EXPECT_EQ(findLost(budgets, scenes)[0].reason,
            "b.toml, line 3: require_seen requires material 'Her?', but none of the scenes 'Lamp', 'Lamp' has one");
}

TEST(Budget, AMaterialWithoutPixelsIsNotSeenAndFailsWhereItMustBeSeen) {
  compare::Budgets budgets = compare::defaultBudgets();
  MaterialResult material = makeMaterial("x", 0, 0);
  judgeMaterial(material, budgets, "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::notSeen);
  EXPECT_TRUE(material.checks.empty());
  EXPECT_FALSE(material.reason.empty());
  budgets.materials[0].requireSeen = true;
  judgeMaterial(material, budgets, "scene");
  EXPECT_EQ(material.verdict, compare::Verdict::fail);
  EXPECT_NE(material.reason.find("requires"), std::string::npos);
}

TEST(Budget, TheReasonListsEachCheckOfTheWorstVerdictAndNoOther) {
  MaterialResult material = makeMaterial("x", 0.25, 4000, std::exp2(-1.));
  judgeMaterial(material, compare::defaultBudgets(), "scene"); // p95 is 0.625: all fail
  EXPECT_EQ(material.reason, "mean FLIP 0.250 is above 0.200; 95th percentile of FLIP 0.625 is above 0.500; mean "
                             "exposure difference -1.00 EV is beyond ±0.50 EV");
  setFigure(material.figures, "bias.ev", -0.3); // that warns
  judgeMaterial(material, compare::defaultBudgets(), "scene");
  EXPECT_EQ(material.reason, "mean FLIP 0.250 is above 0.200; 95th percentile of FLIP 0.625 is above 0.500");
}

TEST(Budget, DefaultsJudgeEveryMaterialAndEveryWholeImage) {
  for (const char* name : {"", "Glass", "日本語", "\xFF"}) {
    const compare::BudgetRule* rule = compare::findMaterialRule(compare::defaultBudgets(), "any", name);
    ASSERT_NE(rule, nullptr);
    EXPECT_FALSE(rule->checks.empty());
    EXPECT_EQ(rule->origin, "built-in");
  }
  ASSERT_NE(compare::findWholeRule(compare::defaultBudgets(), "any"), nullptr);
}

// What budget.h and the page say a FLIP figure means, by our FLIP on even greys. Expected: FLIP = 0.95/(0.4 cmax) *
// dL*^0.7 (docs/flip-metric.md 4; no features), L* = 116 Y^(1/3) - 16 (CIE 15:2004).
TEST(Budget, TheLimitsMeanWhatTheDocumentationSays) {
  const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
  const auto encode = [](double y) { return static_cast<float>(1.055 * std::pow(y, 1 / 2.4) - 0.055); };
  const double slope = 0.95 / (0.4 * 41.2760963);
  EXPECT_NEAR(slope, 0.0575, 5e-5);
  const double grey = 0.2;
  for (const auto& [gain, documented] :
       {std::pair{1.10, 0.10}, {1.29, 0.20}, {0.76, 0.20}, {1.54, 0.30}, {2.3, 0.50}, {1 / 3.2, 0.50}}) {
    const double expected = slope * std::pow(std::abs(lightness(gain * grey) - lightness(grey)), 0.7);
    EXPECT_NEAR(expected, documented, 0.006) << gain;
    const base::Image map =
        compare::flipMap(base::Image(8, 8, 3, encode(grey)), base::Image(8, 8, 3, encode(gain * grey)));
    EXPECT_NEAR(map.pixels[27], expected, 1e-3) << gain;
  }
  // One step of 8 bit at this grey.
  const float code = std::round(encode(grey) * 255);
  const base::Image map = compare::flipMap(base::Image(8, 8, 3, code / 255), base::Image(8, 8, 3, (code + 1) / 255));
  EXPECT_NEAR(map.pixels[27], 0.03, 0.003);
}

TEST(Budget, TheLimitsOfExposureMeanWhatTheDocumentationSays) {
  const base::PixelList list = compare::wholeImage(8, 8);
  for (const auto& [gain, ev] : {std::pair{1.19f, 0.25}, {1.41f, 0.5}}) {
    const base::Image shown(8, 8, 3, 0.5f), reference(8, 8, 3, 0.3f), test(8, 8, 3, 0.3f * gain);
    const compare::Measurement measured =
        compare::measureRegions({shown, shown, &reference, &test}, {list}, {.statistics = {"bias.ev"}});
    EXPECT_NEAR(measured.regions[0].find("bias.ev").value(), ev, 0.005) << gain;
  }
}

TEST(Budget, AMaterialIsToldTheLeastPixelsOfItsRule) {
  compare::Budgets budgets = compare::defaultBudgets();
  budgets.materials.front().minPixels = 500;
  MaterialResult material = makeMaterial("m", 0.01, 1000);
  judgeMaterial(material, budgets, "s");
  EXPECT_EQ(material.rule.minPixels, 500u);
}

} // namespace
} // namespace parity::report
