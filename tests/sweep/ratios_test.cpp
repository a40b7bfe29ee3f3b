// A sweep against an earlier one.
#include <gtest/gtest.h>

#include "base/error.h"
#include "sweep/ratios.h"
#include "sweep/samples.h"

namespace parity::sweep {
namespace {

SweepReport makeReport(double slowdown) {
  SweepReport report;
  VariantResult table = makeVariant("highend", "lut-size 8", 0, 0.5);
  table.stage = Stage::preparation;
  table.times = {};
  table.prepareMs = {3, 3.1, 3.2};
  report.scenes = {makeSceneSweep(
      "a", {makeVariant("highend", "default", 10, 0.2), makeVariant("mobile", "default", 5 * slowdown, 0.3), table})};
  return report;
}

TEST(Ratios, onlyWhatIsSlowerIsCalledSo) {
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

TEST(Ratios, whatOnlyOneHasAndWhatDiffersIsSaid) {
  SweepReport before = makeReport(1), now = makeReport(1);
  before.machine.processor = "old";
  now.machine.processor = "new";
  now.scenes[0].variants.push_back(makeVariant("mobile", "new one", 3, 0.1));
  now.scenes.push_back(makeSceneSweep("b", {makeVariant("mobile", "default", 3, 0.1)}));
  const SweepRatios ratios = compareSweeps(before, now);
  ASSERT_EQ(ratios.notes.size(), 3u);
  EXPECT_EQ(ratios.notes[0], "another processor: old then, new now");
  EXPECT_EQ(ratios.notes[1], "a, mobile: new one: not in the earlier sweep");
  EXPECT_EQ(ratios.notes[2], "b: not in the earlier sweep");
}

TEST(Ratios, nothingInCommonIsAnError) {
  SweepReport now = makeReport(1);
  now.scenes[0].pixels = 999;
  EXPECT_THROW(compareSweeps(makeReport(1), now), base::Error);
}

} // namespace
} // namespace parity::sweep
