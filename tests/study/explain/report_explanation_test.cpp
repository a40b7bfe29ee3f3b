// Explanations as a report has them.
#include "study/explain/report_explanation.h"

#include <gtest/gtest.h>

#include "report/report.h"
#include "report/wording.h"

namespace parity::explain {
namespace {

MaterialExplanation gold() {
  MaterialExplanation m;
  m.name = "gold";
  m.limit = 0.1;
  m.flip = {0.2, 0.21, 0.15, 0.05};
  m.best = {{0, 0.2, {300, 2}, {}}, {2, 0.15, {310, 2}, {}}, {3, 0.05, {330, 3}, 0.05}};
  m.alone = {{1, 0.21, {}, {}}, {2, 0.15, {}, {}}};
  m.worth = {0.045, 0.105};
  m.repair = 3;
  m.ranges = {{"roughness", 0, 0.1, 0.25, 0.75}};
  m.advice = {"a=1 + b=2: mean FLIP 0.050 instead of 0.200.", "second"};
  return m;
}

const std::vector<Switch> kTwoSwitches = {
    {.name = "a", .value = "1", .words = {}, .approximation = "the form of a", .needs = {}, .knobs = {}},
    {.name = "b", .value = "2", .words = {}, .approximation = "the form of b", .needs = {}, .knobs = {}}};

TEST(ReportExplanation, HasTheLargestApproximationFirstAndTheSetsBySize) {
  const report::Explanation e = explanationOf(gold(), kTwoSwitches);
  ASSERT_EQ(e.approximations.size(), 2u);
  EXPECT_EQ(e.approximations[0].approximation, "the form of b");
  EXPECT_NEAR(e.approximations[0].alone, 0.05, 1e-12);
  EXPECT_NEAR(e.approximations[1].alone, -0.01, 1e-12);
  EXPECT_EQ(e.approximations[1].share, 0.045);
  ASSERT_EQ(e.sets.size(), 3u);
  EXPECT_TRUE(e.sets[0].changes.empty());
  EXPECT_EQ(e.sets[2].changes, (std::vector<std::string>{"a=1", "b=2"}));
  EXPECT_EQ(e.sets[2].operations, 330);
  EXPECT_EQ(e.advised, 2u);
  ASSERT_EQ(e.ranges.size(), 1u);
  EXPECT_EQ(e.ranges[0].flip, 0.75);
  EXPECT_EQ(e.words, "approximation: the form of b, 0.105 of FLIP 0.200; a=1 + b=2: mean FLIP 0.050 instead of 0.200");
}

TEST(ReportExplanation, StandsBehindTheCauseByTerms) {
  report::MaterialResult material;
  EXPECT_EQ(report::describeCauses(material, "highend"), "");
  material.explanation = explanationOf(gold(), kTwoSwitches);
  EXPECT_TRUE(report::describeCauses(material, "highend").starts_with("approximation: the form of b"));
  material.attribution = {0.2, {{"skySpecular", 0.05}}};
  EXPECT_TRUE(report::describeCauses(material, "highend").starts_with("skySpecular"));
  EXPECT_TRUE(report::describeCauses(material, "highend").find("; approximation: ") != std::string::npos);
}

TEST(ReportExplanation, NamesNoApproximationThatAddsNothing) {
  MaterialExplanation m = gold();
  m.worth = {-0.02, 0.0005};
  m.advice.clear();
  EXPECT_EQ(explanationOf(m, kTwoSwitches).words, "");
}

} // namespace
} // namespace parity::explain
