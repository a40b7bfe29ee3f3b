// What is given back is memory alone.
#include <gtest/gtest.h>

#include "report/sample_report.h"
#include "report/trim.h"

namespace parity::report {
namespace {

TEST(Trim, GivesBackWhatListsAndTextsDoNotHold) {
  Report report = makeSampleReportWithTruth();
  const std::string before = toJson(report);
  SceneResult& scene = report.scenes[0];
  scene.views.reserve(100);
  scene.views[0].materials.reserve(100);
  MaterialResult& metal = scene.views[0].materials[1];
  metal.reason.reserve(1000);
  metal.checks.reserve(100);
  metal.attribution->terms.reserve(100);
  metal.truth->figures.test.values.reserve(100);
  trim(scene);
  EXPECT_EQ(scene.views.capacity(), scene.views.size());
  EXPECT_EQ(scene.views[0].materials.capacity(), scene.views[0].materials.size());
  const MaterialResult& trimmed = scene.views[0].materials[1];
  EXPECT_LT(trimmed.reason.capacity(), 1000u);
  EXPECT_EQ(trimmed.checks.capacity(), trimmed.checks.size());
  EXPECT_EQ(trimmed.attribution->terms.capacity(), trimmed.attribution->terms.size());
  EXPECT_EQ(trimmed.truth->figures.test.values.capacity(), trimmed.truth->figures.test.values.size());
  EXPECT_EQ(toJson(report), before);
}

} // namespace
} // namespace parity::report
