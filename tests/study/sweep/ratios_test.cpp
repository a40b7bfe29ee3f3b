// A sweep against an earlier one.
#include <random>

#include <gtest/gtest.h>

#include "base/error.h"
#include "study/sweep/ratios.h"
#include "study/sweep/samples.h"

namespace parity::sweep {
namespace {

SweepReport makeReport(double slowdown) {
  SweepReport report;
  VariantResult table = makeVariant("highend", "lut-size 8", 0, 0.5);
  table.stage = Stage::preparation;
  table.times = {};
  table.prepareMs = aboutMs(3.1);
  report.scenes = {makeSceneSweep(
      "a", {makeVariant("highend", "default", 10, 0.2), makeVariant("mobile", "default", 5 * slowdown, 0.3), table})};
  return report;
}

TEST(Ratios, OnlyWhatIsSlowerIsCalledSo) {
  const SweepRatios same = compareSweeps(makeReport(1), makeReport(1));
  EXPECT_FALSE(same.anySlower());
  EXPECT_EQ(same.variants.size(), 3u);
  EXPECT_NEAR(same.confidence, 1 - 0.05 / 3, 1e-12);
  EXPECT_TRUE(same.notes.empty());
  const SweepRatios slower = compareSweeps(makeReport(1), makeReport(1.2));
  EXPECT_TRUE(slower.anySlower());
  EXPECT_FALSE(slower.variants[0].time.isSlower());
  EXPECT_TRUE(slower.variants[1].time.isSlower());
  EXPECT_NEAR(slower.variants[1].time.ratio, 1.2, 1e-9);
  EXPECT_FALSE(compareSweeps(makeReport(1.2), makeReport(1)).anySlower());
}

TEST(Ratios, WhatOnlyOneHasAndWhatDiffersIsSaid) {
  SweepReport before = makeReport(1), now = makeReport(1);
  before.machine.processor = "old";
  now.machine.processor = "new";
  now.scenes[0].variants.push_back(makeVariant("mobile", "new one", 3, 0.1));
  now.scenes.push_back(makeSceneSweep("b", {makeVariant("mobile", "default", 3, 0.1)}));
  const SweepRatios ratios = compareSweeps(before, now);
  ASSERT_EQ(ratios.notes.size(), 3u);
  EXPECT_EQ(ratios.notes[0], "the processor differs: old in the earlier sweep, new now");
  EXPECT_EQ(ratios.notes[1], "a, mobile: new one: not in the earlier sweep");
  EXPECT_EQ(ratios.notes[2], "b: not in the earlier sweep");
}

TEST(Ratios, AnotherSettingOfTheSameNameIsLeftOut) {
  SweepReport before = makeReport(1), now = makeReport(1.2);
  before.scenes[0].variants[1].knobs = {{"preset", "another"}};
  before.scenes[0].variants.push_back(makeVariant("mobile", "old one", 3, 0.1));
  before.scenes.push_back(makeSceneSweep("old", {makeVariant("mobile", "default", 3, 0.1)}));
  now.scenes.push_back(makeSceneSweep("failed", {}));
  now.scenes.back().failure = "lost";
  const SweepRatios ratios = compareSweeps(before, now);
  EXPECT_FALSE(ratios.anySlower());
  EXPECT_EQ(ratios.notes,
            (std::vector<std::string>{"a, mobile: default: was another setting in the earlier sweep; not compared",
                                      "a, mobile: old one: only in the earlier sweep",
                                      "failed: could not be measured now", "old: only in the earlier sweep"}));
}

// Three times against three lie apart by chance once in ten.
TEST(Ratios, FewRoundsAreNotJudged) {
  SweepReport before = makeReport(1), now = makeReport(2);
  for (SweepReport* report : {&before, &now})
    for (VariantResult& v : report->scenes[0].variants)
      v.times.deviceMs.resize(std::min<std::size_t>(3, v.times.deviceMs.size()));
  const SweepRatios ratios = compareSweeps(before, now);
  EXPECT_FALSE(ratios.anySlower());
  ASSERT_EQ(ratios.variants.size(), 1u) << "the table's nine rounds";
  EXPECT_EQ(ratios.notes, std::vector<std::string>{"2 settings are not judged, because they have too few rounds"});
}

// Sixty settings that are what they were: how often is any called slower? Wanted: at most one sweep in twenty.
TEST(Ratios, ChanceAloneIsSeldomCalledASlowDown) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(1, 0.05);
  const auto make = [&] {
    SweepReport report;
    std::vector<VariantResult> variants;
    for (int i = 0; i < 60; ++i) {
      variants.push_back(makeVariant("mobile", "setting " + std::to_string(i), 1, 0.1));
      for (double& time : variants.back().times.deviceMs) time = 10 * noise(random);
    }
    report.scenes = {makeSceneSweep("a", variants)};
    return report;
  };
  int called = 0;
  for (int sweep = 0; sweep < 20; ++sweep) called += compareSweeps(make(), make()).anySlower();
  EXPECT_LE(called, 3);
}

TEST(Ratios, NothingInCommonIsAnError) {
  SweepReport now = makeReport(1);
  now.scenes[0].pixels = 999;
  EXPECT_THROW(compareSweeps(makeReport(1), now), base::Error);
}

} // namespace
} // namespace parity::sweep
