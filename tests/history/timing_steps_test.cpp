// A step in times is found where it is; noise alone, and a lone slow night, are none.
#include "history/timing_steps.h"

#include <random>

#include "history/history_folder.h"
#include "history/synthetic_nights.h"

namespace parity::tests {
namespace {

std::vector<double> noisy(std::size_t count, double level, double sigma, std::mt19937& random) {
  std::normal_distribution<double> noise(level, sigma * level);
  std::vector<double> series(count);
  for (double& each : series) each = noise(random);
  return series;
}

TEST(FindSteps, AStepOfTenPercentIsFoundWhereItIs) {
  std::mt19937 random(1);
  std::vector<double> series = noisy(40, 100, 0.01, random);
  const std::vector<double> after = noisy(20, 110, 0.01, random);
  series.insert(series.end(), after.begin(), after.end());
  const auto steps = history::findSteps(series);
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_NEAR(static_cast<double>(steps[0].at), 40, 1);
  EXPECT_NEAR(steps[0].before, 100, 1);
  EXPECT_NEAR(steps[0].now, 110, 1);
}

TEST(FindSteps, SevenPointsASideAndFivePercentAreTheLeast) {
  std::vector<double> series(20, 100);
  for (std::size_t i = 14; i < 20; ++i) series[i] = 120;
  EXPECT_TRUE(history::findSteps(series).empty()) << "six points";
  series.push_back(120);
  EXPECT_EQ(history::findSteps(series).size(), 1u) << "seven points";
  for (double& each : series) each = each > 100 ? 104 : 100;
  EXPECT_TRUE(history::findSteps(series).empty()) << "four percent";
}

TEST(FindSteps, NoiseIsNoStep) {
  std::mt19937 random(2);
  for (const double sigma : {0.01, 0.05, 0.2})
    for (int i = 0; i < 200; ++i) EXPECT_TRUE(history::findSteps(noisy(100, 50, sigma, random)).empty()) << sigma;
  std::vector<double> spikes = noisy(100, 50, 0.01, random);
  for (std::size_t i = 0; i < spikes.size(); i += 17) spikes[i] *= 3;
  EXPECT_TRUE(history::findSteps(spikes).empty());
}

class TimingStepsTest : public HistoryTest {};

TEST_F(TimingStepsTest, AreToldBySceneAndProcessorWithoutTimesOfTheCache) {
  Nights nights({});
  history::Store store = writer();
  for (int i = 0; i < 60; ++i) {
    history::RunRecord record = nights.next();
    if (i >= 40) record.scenes[2].cpuS *= 1.5;
    if (i % 2 == 1)
      for (history::SceneRecord& scene : record.scenes) scene.machine = "a slower one", scene.cpuS *= 4;
    record.scenes[5].cpuS = i < 30 ? 1 : 0.01, record.scenes[5].isCached = i >= 30;
    store.add(record);
  }
  const auto steps = history::timingSteps(store.index(), {}, 100);
  ASSERT_EQ(steps.size(), 2u);
  for (const history::TimingStep& step : steps) {
    EXPECT_EQ(step.scene, "scene 002");
    EXPECT_NEAR(step.nowMs / step.beforeMs, 1.5, 0.05);
    EXPECT_LE(step.before.id, 40);
    EXPECT_GT(step.now.id, 40);
  }
  EXPECT_NE(steps[0].machine, steps[1].machine);
}

} // namespace
} // namespace parity::tests
