// Totals by cause: every material that failed or warned is in one of them, and the worst is named.
#include <gtest/gtest.h>

#include "report/causes.h"
#include "report/sample_report.h"
#include "report/wording.h"

namespace parity::report {
namespace {

TEST(Causes, AMaterialOfSeveralViewsCountsOnceAndTheWorstIsNamed) {
  Report report = makeSampleReport();
  MaterialResult& back = report.scenes[0].views[1].materials[1]; // Rough metal
  setFigure(back.figures, "flip.mean", 0.4);
  const std::vector<CauseTotal> totals = totalsByCause(report);
  ASSERT_EQ(totals.size(), 2u);
  EXPECT_EQ(totals[0].words, "skySpecular (reflections of the environment)");
  EXPECT_EQ(totals[0].materials, 1u);
  EXPECT_EQ(totals[0].worst->name, "Rough metal");
  EXPECT_EQ(totals[0].view->name, "back");
  EXPECT_EQ(totals[0].scene->name, "Lamp");
  EXPECT_EQ(totals[1].worst->name, "Shade, cloth");
}

TEST(Causes, WhatNoTermExplainsAndWhatWasNotAttributedAreTotalsOfTheirOwn) {
  Report report = makeSampleReport();
  report.scenes[0].views.pop_back();
  std::vector<MaterialResult>& materials = report.scenes[0].views[0].materials;
  materials[1].attribution = {0.27, {{"sunSpecular", 0.26}}};
  std::vector<CauseTotal> totals = totalsByCause(report);
  ASSERT_EQ(totals.size(), 2u);
  EXPECT_EQ(totals[0].words, kNoSingleTerm);
  EXPECT_EQ(totals[1].words, kCauseNotMeasured) << "its check warns";
  EXPECT_NE(toTable(report, {}, {}).find("cause not measured (--attribution all measures warnings, too): 1 material"),
            std::string::npos);
  materials[2] = makeMaterial("Cloth", 0.01, 5000);
  materials[2].notModelled = {"sheen"};
  materials[2].verdict = compare::Verdict::warn;
  totals = totalsByCause(report);
  EXPECT_EQ(totals[1].words, "base layer only: parity does not model sheen");
  materials[1].figures.nonFinite = 3;
  EXPECT_EQ(totalsByCause(report)[0].words, "NaN or infinite pixels");
}

TEST(Causes, AreNoneWhereAllPasses) {
  Report report = makeSampleReport();
  for (ViewResult& view : report.scenes[0].views)
    for (MaterialResult& material : view.materials) material.verdict = compare::Verdict::pass;
  EXPECT_TRUE(totalsByCause(report).empty());
}

} // namespace
} // namespace parity::report
