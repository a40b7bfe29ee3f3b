// What another preset would give is judged as the material itself is, by its own figures.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compare/verdict/budget.h"
#include "report/baseline.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

using compare::Verdict;

MaterialResult makeAsked(double mean, double wouldBe) {
  MaterialResult material = makeMaterial("metal", mean, 90000);
  material.whatIf = {makeWhatIf("refit", wouldBe), makeWhatIf("karis2014", mean)};
  judgeMaterial(material, compare::defaultBudgets(), "Lamp");
  return material;
}

TEST(WhatIf, IsJudgedByItsOwnFigures) {
  const MaterialResult material = makeAsked(0.4, 0.01);
  EXPECT_EQ(material.verdict, Verdict::fail);
  EXPECT_EQ(material.whatIf[0].verdict, Verdict::pass);
  EXPECT_EQ(material.whatIf[0].reason, "");
  EXPECT_EQ(material.whatIf[1].verdict, Verdict::fail);
  EXPECT_NE(material.whatIf[1].reason, "");
  EXPECT_EQ(makeAsked(0.01, 0.4).whatIf[0].verdict, Verdict::fail);
}

TEST(WhatIf, SaysBothFiguresAndTheVerdict) {
  const MaterialResult material = makeAsked(0.4, 0.01);
  EXPECT_EQ(material.whatIf[0].words, "with refit: FLIP 0.010 instead of 0.400, -0.01 EV instead of -0.07 EV, pass");
  EXPECT_EQ(describeWhatIfs(material), material.whatIf[0].words + "; " + material.whatIf[1].words);
  MaterialResult unmeasured = material;
  for (WhatIf& each : unmeasured.whatIf) each.figures.values.clear();
  unmeasured.whatIf[0].verdict = Verdict::error;
  EXPECT_EQ(describe(unmeasured.whatIf[0], unmeasured.figures), "with refit: error");
  EXPECT_EQ(describeWhatIfs(makeMaterial("metal", 0.1, 100)), "");
}

TEST(WhatIf, HasTheOtherCausesOfAVerdictToo) {
  MaterialResult material = makeAsked(0.4, 0.01);
  material.notModelled = {"sheen"};
  settleMaterial(material, false);
  EXPECT_EQ(material.whatIf[0].verdict, Verdict::warn) << "base layer only";
  material.figures.pixels = material.whatIf[0].figures.pixels = 12;
  settleMaterial(material, false);
  EXPECT_EQ(material.whatIf[0].verdict, Verdict::tooSmall);
}

TEST(WhatIf, IsHeldAgainstTheBaselineByRegressions) {
  compare::Budgets regressions = compare::defaultBudgets();
  regressions.materials[0].regress = {{compare::requireStatistic("flip.mean", "test"), 0.01, 0.03}};
  Report now = makeSampleReport();
  const Report before = now;
  MaterialResult& glass = now.scenes[0].views[0].materials[0]; // of 0.03
  glass.whatIf = {makeWhatIf("better", 0.02), makeWhatIf("worse", 0.07)};
  judgeMaterial(glass, regressions, "Lamp");
  compareWithBaseline(now, before, {"old/report.json", {}, false});
  EXPECT_EQ(glass.verdict, Verdict::pass) << glass.reason;
  EXPECT_EQ(glass.whatIf[0].verdict, Verdict::pass) << glass.whatIf[0].reason;
  EXPECT_EQ(glass.whatIf[1].verdict, Verdict::fail) << glass.whatIf[1].reason;
  EXPECT_NE(glass.whatIf[1].reason.find("worse than in the baseline"), std::string::npos) << glass.whatIf[1].reason;
}

TEST(WhatIf, TheBestOneHasTheBestVerdictThenTheLeastFlip) {
  using enum Verdict;
  const auto best = [](Verdict now, double flip, const std::vector<std::pair<Verdict, double>>& others) {
    MaterialResult material = makeMaterial("metal", flip, 90000);
    material.verdict = now;
    for (const auto& [verdict, mean] : others) {
      material.whatIf.push_back(makeWhatIf(std::to_string(material.whatIf.size()), mean));
      material.whatIf.back().verdict = verdict;
    }
    const WhatIf* found = bestWhatIf(material);
    return found ? found->preset : "none";
  };
  EXPECT_EQ(best(fail, 0.3, {{warn, 0.1}, {pass, 0.12}, {pass, 0.11}}), "2");
  EXPECT_EQ(best(fail, 0.3, {{fail, 0.25}, {fail, 0.21}}), "1");
  EXPECT_EQ(best(warn, 0.1, {{fail, 0.05}}), "none") << "a graver verdict";
  EXPECT_EQ(best(warn, 0.1, {{warn, 0.095}}), "none") << "less than a tenth";
  EXPECT_EQ(best(warn, 0.1, {{notJudged, 0.01}}), "none") << "it judges less";
  EXPECT_EQ(best(fail, 0.3, {}), "none");
}

TEST(WhatIf, StandsUnderTheRowOfItsMaterial) {
  Report report = makeSampleReport();
  MaterialResult& metal = report.scenes[0].views[0].materials[1];
  metal.whatIf = {makeWhatIf("refit", 0.02)};
  judgeMaterial(metal, compare::defaultBudgets(), "Lamp");
  settleVerdicts(report);
  const std::string table = toTable(report, {}, {.all = true});
  EXPECT_NE(table.find("\n      with refit: FLIP 0.020 instead of 0.270, "), std::string::npos) << table;
  const auto json = nlohmann::json::parse(toJson(report));
  EXPECT_EQ(json["scenes"][0]["views"][0]["materials"][1]["whatIf"][0]["verdict"], "pass");
  EXPECT_FALSE(json["scenes"][0]["views"][0]["materials"][0].contains("whatIf")) << "not asked";
}

} // namespace
} // namespace parity::report
