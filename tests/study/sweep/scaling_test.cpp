// Scenes of a given size, and that what is written can be loaded.
#include <filesystem>

#include <gtest/gtest.h>

#include "base/error.h"
#include "mobile/options.h"
#include "scenes/load.h"
#include "study/sweep/scaling.h"
#include "study/sweep/scaling_scene.h"

namespace parity::sweep {
namespace {

class ScalingScene : public testing::Test {
protected:
  ~ScalingScene() override { std::filesystem::remove_all(m_folder); }
  std::filesystem::path m_folder = std::filesystem::path(testing::TempDir()) / "parity-scaling";
};

TEST_F(ScalingScene, HasWhatItsSizeSays) {
  const scenes::Scene scene = scenes::loadScene(
      writeScalingScene(m_folder, {.triangles = 800, .materials = 4, .textures = 3, .textureSide = 16, .lights = 5})
          .string());
  EXPECT_EQ(scene.triangleCount(), 800u);
  EXPECT_EQ(scene.materials.size(), 4u);
  EXPECT_EQ(scene.lights.size(), 5u);
  EXPECT_EQ(scene.images.size(), 3u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(ScalingScene, ASeriesThatIsUnknownIsAnError) {
  EXPECT_THROW(measureScaling({}, {.series = {"shadows"}}, {}), base::Error);
}

TEST_F(ScalingScene, ASeriesHasAnExponentForEachStage) {
  job::Settings settings;
  settings.of<mobile::Options>().precision = mobile::Precision::fp32;
  settings.device.validation = true;
  const auto all = measureScaling(settings, {.series = {"lights"}, .rounds = 3, .steps = 3, .side = 128}, {});
  ASSERT_EQ(all.size(), 1u);
  for (const ScalingSeries& series : all) {
    EXPECT_EQ(series.grows, "lights");
    ASSERT_EQ(series.points.size(), 3u);
    EXPECT_EQ(series.points[2].n / series.points[1].n, 4) << series.grows;
    EXPECT_EQ(series.exponents.size(), stageNames(settings.pathNames).size());
    for (const ScalingPoint& point : series.points)
      for (const double timeMs : valuesOf(point.times)) EXPECT_GT(timeMs, 0) << series.grows << " " << point.n;
    EXPECT_NE(toText(all).find(series.grows), std::string::npos);
  }
}

} // namespace
} // namespace parity::sweep
