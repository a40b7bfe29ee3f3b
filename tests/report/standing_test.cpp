// Which failures are new, and the exit code where only those count.
#include "report/standing.h"

#include <gtest/gtest.h>

#include "report/baseline.h"
#include "report/judge.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

Report makeStanding(const std::vector<std::pair<const char*, double>>& materials) {
  Report report;
  report.scenes.emplace_back().name = "Hero";
  ViewResult& view = report.scenes[0].views.emplace_back();
  view.name = "front";
  view.whole = makeFigures(0.01, 9000);
  for (const auto& [name, mean] : materials) view.materials.push_back(makeMaterial(name, mean, 4000));
  judgeScene(report.scenes[0], compare::defaultBudgets());
  settleVerdicts(report);
  return report;
}

Report since(Report now, const Report& before) {
  compareWithBaseline(now, before, {"old/report.json", {}, false});
  return now;
}

Standing standingOf(const Report& report, std::size_t material) {
  const ViewResult& view = report.scenes[0].views[0];
  return standingOf(view, &view.materials[material]).standing;
}

TEST(Standing, OfEachRowSinceTheBaseline) {
  const Report report =
      since(makeStanding({{"new", 0.3}, {"still", 0.4}, {"fixed", 0.01}, {"well", 0.01}, {"added", 0.3}}),
            makeStanding({{"new", 0.01}, {"still", 0.3}, {"fixed", 0.3}, {"well", 0.01}}));
  const Standing expected[] = {Standing::isNew, Standing::still, Standing::fixed, Standing::none, Standing::isNew};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(standingOf(report, i), expected[i]) << i;
  EXPECT_EQ(countFailures(report).isNew, 2u);
  EXPECT_EQ(countFailures(report).still, 1u);
  EXPECT_EQ(standingOf(makeStanding({{"a", 0.3}}), 0), Standing::unknown);
}

TEST(Standing, OnlyNewFailuresFailWhereThatIsAsked) {
  const Report before = makeStanding({{"a", 0.3}, {"b", 0.01}});
  const Report same = since(before, before), worse = since(makeStanding({{"a", 0.3}, {"b", 0.3}}), before);
  EXPECT_EQ(exitCode(same, false), 2);
  EXPECT_EQ(exitCode(same, false, FailOn::isNew), 0);
  EXPECT_EQ(exitCode(worse, false, FailOn::isNew), 2);
  EXPECT_EQ(exitCode(same, true, FailOn::isNew), 1) << "a row that fails is no pass";
}

TEST(Standing, WithoutAWholeBaselineNobodyCanTell) {
  const Report now = makeStanding({{"a", 0.3}});
  EXPECT_EQ(exitCode(now, false, FailOn::isNew), 4);
  EXPECT_EQ(whyNewIsUnknown(now), "there is no baseline");
  Report before = makeStanding({{"a", 0.3}});
  EXPECT_EQ(exitCode(since(now, before), false, FailOn::isNew), 0);
  before.only = {"Hero/front"};
  EXPECT_EQ(exitCode(since(now, before), false, FailOn::isNew), 4);
  before.only.clear();
  before.conditions = {{"materials", "a*"}};
  EXPECT_EQ(exitCode(since(now, before), false, FailOn::isNew), 4);
  before.conditions.clear();
  before.scenes.emplace_back().name = "Broken";
  before.scenes[1].error = "no such file";
  const Report report = since(now, before);
  EXPECT_EQ(exitCode(report, false, FailOn::isNew), 4);
  EXPECT_EQ(whyNewIsUnknown(report),
            "the baseline is not complete: 1 of 2 scenes has no result: 'Broken': no such file");
}

TEST(Standing, WhatABudgetRequiresAndNoSceneHasCounts) {
  const Report before = makeStanding({{"a", 0.01}});
  Report now = before;
  now.lost.push_back({compare::Verdict::fail, "no scene has 'Hero'", "", 0});
  now = since(now, before);
  EXPECT_EQ(exitCode(now, false, FailOn::isNew), 2);
  EXPECT_EQ(countFailures(now).isNew, 1u);
}

} // namespace
} // namespace parity::report
