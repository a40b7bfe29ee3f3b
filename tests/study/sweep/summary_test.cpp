// Many scenes in one table.
#include <cmath>

#include <gtest/gtest.h>

#include "study/sweep/samples.h"
#include "study/sweep/summary.h"

namespace parity::sweep {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

SweepReport makeSummedReport() {
  SweepReport report;
  report.scenes = {
      makeSceneSweep("a", {makeVariant("highend", "default", 10, 0.1), makeVariant("highend", "x", 5, 0.2)}),
      makeSceneSweep("b|c", {makeVariant("highend", "default", 10, 0.3), makeVariant("highend", "x", 20, 0.6)}),
      makeSceneSweep("d", {makeVariant("highend", "default", 10, 0.2)})};
  report.scenes.emplace_back().failure = "no such file";
  return report;
}

TEST(Summary, HoldsMedianAndWorstOfTheScenesThatHaveASetting) {
  const std::vector<SettingSummary> all = summarise(makeSummedReport());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].id, "highend: default");
  EXPECT_EQ(all[0].scenes, 3u);
  EXPECT_DOUBLE_EQ(all[0].time, 1);
  EXPECT_DOUBLE_EQ(all[0].flip.median, 0.2);
  EXPECT_DOUBLE_EQ(all[0].flip.worst, 0.3);
  EXPECT_DOUBLE_EQ(all[0].relMse.worst, 0.3 * 0.3) << "as samples.h makes it";
  EXPECT_EQ(all[1].scenes, 2u);
  EXPECT_DOUBLE_EQ(all[1].time, 0.5 * (0.5 + 2.0)) << "of each scene's own default";
  EXPECT_DOUBLE_EQ(all[1].fromFirst.median, 0.5 * (0.1 + 0.3)) << "half of that against the truth, in samples.h";
  EXPECT_DOUBLE_EQ(all[1].fromFirstOfParts.worst, 0.6);
}

TEST(Summary, AFigureThatIsNoNumberIsTheWorst) {
  SweepReport report = makeSummedReport();
  report.scenes[0].variants[1].whole.truth->relMse = std::nan("");
  EXPECT_TRUE(std::isnan(summarise(report)[1].relMse.worst));
  EXPECT_FALSE(std::isnan(summarise(report)[0].relMse.worst));
}

TEST(Summary, NotesSayWhatLimitsIt) {
  SweepReport report = makeSummedReport();
  report.scenes[3].scene = "gone";
  report.scenes[0].variants[0].knobs = {{"lut-size", "32"}};
  report.scenes[1].variants[0].knobs = {{"lut-size", "64"}};
  report.scenes[2].variants[0].knobs = {{"lut-size", "32"}};
  for (VariantResult& v : report.scenes[2].variants) v.whole.truth.reset();
  EXPECT_EQ(notesOf(report),
            (std::vector<std::string>{"b|c: the default of highend has lut-size 64, but 32 in a. Figures over all "
                                      "scenes use the default of each scene",
                                      "d: has no truth, so all errors are against the default of the first path",
                                      "gone: not measured: no such file"}));
  const std::string text = toMarkdown(report);
  EXPECT_TRUE(holds(text, "- b\\|c: the default")) << text;
  EXPECT_TRUE(holds(text, "\n\n| setting")) << "a table begins after an empty line";
  report.scenes = {report.scenes[0]};
  EXPECT_TRUE(notesOf(report).empty());
}

TEST(Summary, IsATableWithAColumnAScene) {
  SweepReport report = makeSummedReport();
  const std::string text = toMarkdown(report);
  EXPECT_TRUE(holds(text, "| highend: x | 2 | 1.25 | 0.4000 | 0.6000 |")) << text;
  EXPECT_TRUE(holds(text, "FLIP of each scene against the truth:"));
  EXPECT_TRUE(holds(text, "| setting | a | b\\|c | d |")) << text;
  EXPECT_TRUE(holds(text, "| highend: x | 0.2000 | 0.6000 | |")) << text;
  for (SceneSweep& scene : report.scenes)
    for (VariantResult& v : scene.variants) v.whole.truth.reset();
  EXPECT_TRUE(holds(toMarkdown(report), "| highend: x | 0.1000 | 0.3000 | |")) << "against the first path";
  EXPECT_TRUE(holds(toMarkdown(report), "FLIP against high-end | worst |"));
}

} // namespace
} // namespace parity::sweep
