// Budgets: limits, rules, and that nothing passes that was not measured.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "compare/budget.h"
#include "compare/flip.h"
#include "compare/sample_report.h"

namespace parity::compare {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

BudgetRule ruleOf(std::vector<BudgetCheck> checks) {
  BudgetRule rule;
  rule.checks = std::move(checks);
  return rule;
}

Verdict verdictAt(const BudgetCheck& check, double value) {
  RegionFigures figures = makeRegion("m", 0.1, 4000);
  for (Figures* part : {&figures.all, &figures.interior}) {
    part->flip = {value, value, value, value};
    part->rmse = part->psnr = value;
  }
  return runChecks(ruleOf({check}), figures).at(0).verdict;
}

TEST(Budget, EachMetricNamesItsOwnFigure) {
  Figures figures;
  figures.flip = {0.1, 0.2, 0.3, 0.4};
  figures.rmse = 0.5;
  figures.psnr = 60;
  const std::vector<double> expected = {0.1, 0.2, 0.3, 0.4, 0.5, 60};
  ASSERT_EQ(kMetricNames.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto metric = metricByName(kMetricNames[i]);
    ASSERT_TRUE(metric) << kMetricNames[i];
    EXPECT_EQ(valueOf(figures, *metric), expected[i]) << kMetricNames[i];
    EXPECT_EQ(nameOf(*metric), kMetricNames[i]);
    EXPECT_FALSE(labelOf(*metric).empty());
  }
  EXPECT_FALSE(metricByName("flip"));
  EXPECT_FALSE(metricByName(""));
}

TEST(Budget, BeyondALimitIsStrictlyBeyondIt) {
  const BudgetCheck check{Metric::flipMean, Region::interior, 0.1, 0.2};
  EXPECT_EQ(verdictAt(check, 0), Verdict::pass);
  EXPECT_EQ(verdictAt(check, 0.1), Verdict::pass);
  EXPECT_EQ(verdictAt(check, std::nextafter(0.1, 1)), Verdict::warn);
  EXPECT_EQ(verdictAt(check, 0.2), Verdict::warn);
  EXPECT_EQ(verdictAt(check, std::nextafter(0.2, 1)), Verdict::fail);
}

TEST(Budget, PsnrIsALowerBoundAndIdenticalImagesPassAny) {
  const BudgetCheck check{Metric::psnr, Region::interior, 32, 28};
  EXPECT_EQ(verdictAt(check, 40), Verdict::pass);
  EXPECT_EQ(verdictAt(check, 32), Verdict::pass);
  EXPECT_EQ(verdictAt(check, 31.9), Verdict::warn);
  EXPECT_EQ(verdictAt(check, 27.9), Verdict::fail);
  EXPECT_EQ(verdictAt(check, kInfinity), Verdict::pass);
}

TEST(Budget, EitherLimitMayStandAlone) {
  EXPECT_EQ(verdictAt({Metric::rmse, Region::all, std::nullopt, 0.2}, 0.15), Verdict::pass);
  EXPECT_EQ(verdictAt({Metric::rmse, Region::all, std::nullopt, 0.2}, 0.25), Verdict::fail);
  EXPECT_EQ(verdictAt({Metric::rmse, Region::all, 0.1, std::nullopt}, 0.9), Verdict::warn);
}

TEST(Budget, NotANumberIsAnErrorForEveryMetric) {
  for (const std::string_view name : kMetricNames)
    EXPECT_EQ(verdictAt({*metricByName(name), Region::interior, 0.5, 0.5}, kNan), Verdict::error) << name;
}

TEST(Budget, ChecksLookAtTheirRegion) {
  RegionFigures figures = makeRegion("m", 0.1, 4000);
  figures.all.flip.mean = 0.9;
  const auto results = runChecks(
      ruleOf({{Metric::flipMean, Region::interior, 0.2, 0.5}, {Metric::flipMean, Region::all, 0.2, 0.5}}), figures);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0].verdict, Verdict::pass);
  EXPECT_EQ(results[0].region, "interior");
  EXPECT_EQ(results[1].verdict, Verdict::fail);
  EXPECT_EQ(results[1].value, 0.9);
  EXPECT_EQ(results[1].note, "");
}

TEST(Budget, AnEmptyInteriorFallsBackToAllPixelsAndSaysSo) {
  RegionFigures figures = makeRegion("thin wire", 0.1, 40);
  figures.interior = {};
  figures.all.flip.mean = 0.9;
  const auto results = runChecks(ruleOf({{Metric::flipMean, Region::interior, 0.2, 0.5}}), figures);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].verdict, Verdict::fail);
  EXPECT_EQ(results[0].region, "all");
  EXPECT_NE(results[0].note.find("no interior pixels"), std::string::npos);
}

TEST(Budget, TheFirstRuleThatMatchesJudges) {
  Budgets budgets;
  BudgetRule hero = ruleOf({{Metric::flipMean, Region::interior, 0.01, 0.02}});
  hero.material = "Hero*";
  hero.scene = "Title*";
  hero.owner = "characters";
  BudgetRule loose = ruleOf({{Metric::flipMean, Region::interior, 0.8, 0.9}});
  loose.material = "Hero*";
  budgets.materials = {hero, loose};
  EXPECT_EQ(findMaterialRule(budgets, "Title screen", "Hero face"), &budgets.materials[0]);
  EXPECT_EQ(findMaterialRule(budgets, "Level 1", "Hero face"), &budgets.materials[1]);
  EXPECT_EQ(findMaterialRule(budgets, "Level 1", "hero face"), nullptr);

  MaterialResult material = makeMaterial("Hero face", 0.1, 4000);
  judgeMaterial(material, budgets, "Title screen");
  EXPECT_EQ(material.verdict, Verdict::fail);
  EXPECT_EQ(material.owner, "characters");
  EXPECT_EQ(material.reason, "mean FLIP 0.100 over interior pixels is above 0.020");
  judgeMaterial(material, budgets, "Level 1");
  EXPECT_EQ(material.verdict, Verdict::pass);
  EXPECT_EQ(material.owner, "");
  EXPECT_EQ(material.reason, "");
}

TEST(Budget, NoRuleThatMatchesIsAnErrorNotAPass) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  judgeMaterial(material, Budgets{}, "scene");
  EXPECT_EQ(material.verdict, Verdict::error);
  EXPECT_EQ(material.reason, "no budget check applies");
}

TEST(Budget, NonFinitePixelsFailInWordsWhateverTheFiguresSay) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  material.figures.all.nonFinite = 3;
  judgeMaterial(material, defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, Verdict::fail);
  EXPECT_EQ(material.reason, "3 of 4000 pixels are NaN or infinite in one of the two renders");
}

TEST(Budget, AFigureThatNoCheckLooksAtMayNotBeNanEither) {
  MaterialResult material = makeMaterial("x", 0, 4000);
  material.figures.interior.testLuma = kNan;
  judgeMaterial(material, defaultBudgets(), "scene");
  EXPECT_EQ(material.verdict, Verdict::error);
}

TEST(Budget, AMaterialWithoutPixelsIsNotSeenAndFailsWhereItMustBeSeen) {
  Budgets budgets = defaultBudgets();
  MaterialResult material = makeMaterial("x", 0, 0);
  judgeMaterial(material, budgets, "scene");
  EXPECT_EQ(material.verdict, Verdict::notSeen);
  EXPECT_TRUE(material.checks.empty());
  EXPECT_FALSE(material.reason.empty());
  budgets.materials[0].requireSeen = true;
  judgeMaterial(material, budgets, "scene");
  EXPECT_EQ(material.verdict, Verdict::fail);
  EXPECT_NE(material.reason.find("requires"), std::string::npos);
}

TEST(Budget, TheReasonNamesTheWorstCheckAndCountsItsEquals) {
  MaterialResult material = makeMaterial("x", 0.25, 4000);
  judgeMaterial(material, defaultBudgets(), "scene"); // p95 is 0.625: both fail
  EXPECT_EQ(material.reason, "mean FLIP 0.250 over interior pixels is above 0.200 (and 1 more)");
}

TEST(Budget, DefaultsJudgeEveryMaterialAndEveryWholeImage) {
  for (const char* name : {"", "Glass", "日本語", "\xFF"}) {
    const BudgetRule* rule = findMaterialRule(defaultBudgets(), "any", name);
    ASSERT_NE(rule, nullptr);
    EXPECT_FALSE(rule->checks.empty());
    EXPECT_EQ(rule->origin, "built-in");
  }
  ASSERT_NE(findWholeRule(defaultBudgets(), "any"), nullptr);
}

// What budget.h and the page say a FLIP figure means, by our FLIP on even greys. Expected: FLIP = 0.95/(0.4 cmax) *
// dL*^0.7 (FLIP.md, colour difference; no features), L* = 116 Y^(1/3) - 16 (CIE 15:2004).
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
    const base::Image map = flipMap(base::Image(8, 8, 3, encode(grey)), base::Image(8, 8, 3, encode(gain * grey)));
    EXPECT_NEAR(map.pixels[27], expected, 1e-3) << gain;
  }
  // One step of 8 bit at this grey.
  const float code = std::round(encode(grey) * 255);
  const base::Image map = flipMap(base::Image(8, 8, 3, code / 255), base::Image(8, 8, 3, (code + 1) / 255));
  EXPECT_NEAR(map.pixels[27], 0.03, 0.003);
}

} // namespace
} // namespace parity::compare
