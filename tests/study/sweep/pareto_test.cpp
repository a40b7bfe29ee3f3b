// Which settings are dominated, the cheapest within a budget, and what a knob buys.
#include <cmath>

#include <gtest/gtest.h>

#include "base/error.h"
#include "study/sweep/pareto.h"
#include "study/sweep/samples.h"

namespace parity::sweep {
namespace {

const std::string kFlip = "flip.mean";

TEST(Pareto, DominatedIsWhatAnotherBeatsInBoth) {
  const SceneSweep scene = makeSceneSweep(
      "s", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "slow and bad", 12, 0.3),
            makeVariant("mobile", "slow and good", 20, 0.1), makeVariant("mobile", "as fast, worse", 10, 0.25),
            makeVariant("highend", "default", 9, 0.01)});
  EXPECT_EQ(findDominated(scene, Against::truth, kFlip), (std::vector<bool>{false, true, false, true, false}))
      << "the other path is no rival";
}

TEST(Pareto, EqualsDominateNeitherOfThem) {
  const SceneSweep scene =
      makeSceneSweep("s", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "twin", 10, 0.2)});
  EXPECT_EQ(findDominated(scene, Against::truth, kFlip), (std::vector<bool>{false, false}));
}

TEST(Pareto, TimesThatNoiseCannotTellApartDecideNothing) {
  VariantResult first = makeVariant("mobile", "default", 10, 0.2), second = makeVariant("mobile", "twin", 10, 0.2);
  first.times.deviceMs = {9, 10, 11, 12};
  second.times.deviceMs = {9.5, 10.5, 11.5, 12.5};
  const auto dominated = [&] { return findDominated(makeSceneSweep("s", {first, second}), Against::truth, kFlip); };
  EXPECT_EQ(dominated(), (std::vector<bool>{false, false})) << "the median of one is 5 % less";
  second.whole.truth->flipMean = 0.1;
  EXPECT_EQ(dominated(), (std::vector<bool>{true, false})) << "as fast, and better";
  for (double& time : second.times.deviceMs) time += 10;
  EXPECT_EQ(dominated(), (std::vector<bool>{false, false})) << "better, but slower";
}

TEST(Pareto, AnErrorThatIsNoNumberIsDominated) {
  const SceneSweep scene = makeSceneSweep(
      "s", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "broken", 1, std::nan(""))});
  EXPECT_EQ(findDominated(scene, Against::truth, kFlip), (std::vector<bool>{false, true}));
}

TEST(Pareto, PreparationIsComparedWithPreparationAndStorageWithNothing) {
  VariantResult table = makeVariant("highend", "lut-size 8", 0, 0.5), stored = makeVariant("highend", "8 bits", 0, 0.9);
  table.stage = Stage::preparation;
  table.prepareMs = {3, 4, 5};
  stored.stage = Stage::storage;
  const SceneSweep scene = makeSceneSweep("s", {makeVariant("highend", "default", 1, 0.1), table, stored});
  EXPECT_EQ(timeOf(table), 4);
  EXPECT_EQ(findDominated(scene, Against::truth, kFlip), (std::vector<bool>{false, false, false}));
}

TEST(Pareto, EverywhereMeansInEachSceneThatHasIt) {
  SweepReport report;
  report.scenes = {
      makeSceneSweep("a", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "x", 11, 0.3),
                           makeVariant("mobile", "y", 11, 0.3)}),
      makeSceneSweep("b", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "x", 11, 0.1)})};
  EXPECT_EQ(dominatedEverywhere(report, Against::truth, kFlip), std::vector<std::string>{"mobile: y"});
}

TEST(Budget, IsReadOrRefused) {
  EXPECT_EQ(parseErrorBudget("flip.p95=0.25").figure, "flip.p95");
  EXPECT_EQ(parseErrorBudget("flip.p95=0.25").limit, 0.25);
  EXPECT_EQ(parseErrorBudget("flip=0.25").figure, "flip.mean") << "a metric stands for its first figure";
  for (const char* bad : {"", "flip.mean", "flip.mean=", "flip.mean=x", "flip.mean=0", "flip.mean=-1", "ssim=0.5",
                          "flip,relmse=0.5", "flop=0.5", "flip.mean=0.1x", "flip.mean=nan", "flip.mean=inf"})
    EXPECT_THROW(parseErrorBudget(bad), base::Error) << bad;
}

TEST(Budget, TheFastestWithinItIsNamedSceneBySceneAndForAll) {
  SweepReport report;
  report.scenes = {
      makeSceneSweep("a", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "fast", 5, 0.09),
                           makeVariant("mobile", "good", 8, 0.05)}),
      makeSceneSweep("b", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "fast", 5, 0.15),
                           makeVariant("mobile", "good", 8, 0.05)})};
  const ErrorBudget budget{kFlip, 0.1};
  EXPECT_EQ(cheapestWithin(report.scenes[0], "mobile", Against::truth, budget), "fast");
  EXPECT_EQ(cheapestWithin(report.scenes[1], "mobile", Against::truth, budget), "good");
  EXPECT_EQ(cheapestWithinEverywhere(report, "mobile", Against::truth, budget), "good");
  EXPECT_FALSE(cheapestWithinEverywhere(report, "mobile", Against::truth, {kFlip, 0.01}));
  EXPECT_FALSE(cheapestWithin(report.scenes[0], "highend", Against::truth, budget));
}

// 4 ms a round of 1000 samples are 4000 ms a million.
TEST(Purchases, AreFromTheFasterToTheSlowerValueBestFirst) {
  SweepReport report;
  report.scenes = {makeSceneSweep(
      "a", {makeVariant("mobile", "default", 10, 0.2), makeVariant("mobile", "worse and faster", 6, 0.6),
            makeVariant("mobile", "better and slower", 20, 0.1), makeVariant("mobile", "worse and slower", 30, 0.4),
            makeVariant("mobile", "free", 10, 0.3)})};
  const std::vector<Purchase> all = rankPurchases(report, Against::truth, kFlip);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].to, "default") << "what costs nothing counts as 1 %";
  EXPECT_EQ(all[0].from + all[0].to, "freedefault");
  EXPECT_NEAR(all[0].perMs, 0.1 / 100, 1e-9);
  EXPECT_EQ(all[0].certain, 0);
  EXPECT_EQ(all[1].from, "worse and faster");
  EXPECT_NEAR(all[1].timeMs, 4000, 1e-6);
  EXPECT_NEAR(all[1].error, 0.4, 1e-12);
  EXPECT_NEAR(all[1].perMs, 1e-4, 1e-12);
  EXPECT_EQ(all[2].to, "better and slower");
  EXPECT_NEAR(all[2].perMs, 0.1 / 10000, 1e-12);
  EXPECT_EQ(all[3].to, "worse and slower");
  EXPECT_LT(all[3].perMs, 0);
}

TEST(Against, IsTheTruthOnlyWhereAllHaveIt) {
  SweepReport report;
  report.scenes = {makeSceneSweep("a", {makeVariant("mobile", "default", 10, 0.2)})};
  EXPECT_EQ(bestKnown(report), Against::truth);
  report.scenes.push_back(report.scenes[0]);
  report.scenes[1].variants[0].whole.truth.reset();
  EXPECT_EQ(bestKnown(report), Against::first);
}

} // namespace
} // namespace parity::sweep
