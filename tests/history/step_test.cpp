// What git bisect is told of a report.
#include "history/step.h"

#include <cmath>

#include "base/expect_error.h"

namespace parity::tests {
namespace {

using history::StepVerdict;

report::Report makeReport() {
  report::Report report;
  for (const char* name : {"Hero", "Villain"}) {
    report::SceneResult& scene = report.scenes.emplace_back();
    scene.name = name;
    report::ViewResult& view = scene.views.emplace_back();
    view.name = "front";
    view.whole.pixels = 100, view.whole.values = {{"flip.mean", 0.03}, {"psnr", 30}, {"bias.ev", -0.2}};
    report::MaterialResult& material = view.materials.emplace_back();
    material.name = "Chrome", material.figures = view.whole;
    view.materials.emplace_back().name = "Hidden"; // no pixel
  }
  report.scenes[1].views[0].materials[0].figures.values[0].value = 0.08;
  return report;
}

StepVerdict::Kind judge(const report::Report& report, const std::string& limit,
                        const history::StepChoice& choice = {}) {
  return history::judgeStep(report, {history::readLimit(limit)}, choice).kind;
}

TEST(Step, OneRowBeyondTheLimitIsBad) {
  const report::Report report = makeReport();
  EXPECT_EQ(judge(report, "flip.mean=.08"), StepVerdict::good);
  EXPECT_EQ(judge(report, "flip.mean=.0799"), StepVerdict::bad);
  EXPECT_EQ(judge(report, "flip.mean=.05", {.views = {"Hero/*"}}), StepVerdict::good);
  EXPECT_EQ(judge(report, "flip.mean=.05", {.wholes = true}), StepVerdict::good);
  EXPECT_EQ(judge(report, "psnr=30"), StepVerdict::good) << "the least, as more is better";
  EXPECT_EQ(judge(report, "psnr=30.1"), StepVerdict::bad);
  EXPECT_EQ(judge(report, "bias.ev=.19"), StepVerdict::bad) << "of the absolute value";
  EXPECT_EQ(judge(report, "bias.ev=.2"), StepVerdict::good);
}

TEST(Step, WhatCannotBeJudgedIsSkippedUnlessAnotherRowIsBad) {
  report::Report report = makeReport();
  EXPECT_EQ(judge(report, "ssim.mean=.5"), StepVerdict::untestable) << "not measured";
  EXPECT_EQ(judge(report, "flip.mean=.5", {.materials = {"Hidden"}}), StepVerdict::untestable) << "no row with pixels";
  EXPECT_EQ(judge(report, "flip.mean=.5", {.views = {"Nobody"}}), StepVerdict::untestable);
  report.scenes[0].views[0].materials[0].figures.values[0].value = NAN;
  EXPECT_EQ(judge(report, "flip.mean=.5"), StepVerdict::untestable);
  EXPECT_EQ(judge(report, "flip.mean=.05"), StepVerdict::bad);
  report = makeReport();
  report.scenes[0].error = "hero.gltf: does not exist", report.scenes[0].views.clear();
  EXPECT_EQ(judge(report, "flip.mean=.5"), StepVerdict::untestable);
  EXPECT_EQ(judge(report, "flip.mean=.5", {.views = {"Hero/front"}}), StepVerdict::untestable);
  EXPECT_EQ(judge(report, "flip.mean=.5", {.views = {"Villain/front"}}), StepVerdict::good);
}

TEST(Step, LimitsAreFiguresAndNumbers) {
  EXPECT_EQ(history::readLimit("flip.fraction_over(0.10)=.5").figure.name, "flip.fraction_over(0.1)");
  for (const char* text : {"flip.mean", "flip.mean=", "flip.mean=nan", "flip.mean=1x", "=1", ""})
    base::expectError([&] { history::readLimit(text); }, std::vector<std::string>{"--at-most"}, base::ExitCode::usage);
  base::expectError([] { history::readLimit("flip.men=1"); }, "--at-most", "flip.mean", base::ExitCode::usage);
}

} // namespace
} // namespace parity::tests
