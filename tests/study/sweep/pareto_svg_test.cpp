// The picture of time against error.
#include "study/sweep/pareto_svg.h"

#include <gtest/gtest.h>

#include "study/sweep/samples.h"

namespace parity::sweep {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

ParetoDot dot(const std::string& path, const std::string& name, double time, double error, bool dominated = false) {
  return {.path = path, .name = name, .details = "", .time = time, .error = error, .dominated = dominated};
}

TEST(ParetoSvg, PlotsTheSettingsOfAStageThatHaveATimeAndAnError) {
  VariantResult table = makeVariant("highend", "lut-size 8", 0, 0.5);
  table.stage = Stage::preparation;
  table.prepareMs = {3, 4, 5};
  const SceneSweep scene =
      makeSceneSweep("a", {makeVariant("highend", "default", 10, 0.2), makeVariant("mobile", "default", 5, 0.3),
                           makeVariant("mobile", "worse", 6, 0.4), makeVariant("mobile", "exact", 7, 0), table});
  const ParetoPlot plot = plotOf(scene, Stage::shading, Against::truth, "flip.mean");
  ASSERT_EQ(plot.dots.size(), 3u);
  EXPECT_EQ(plot.dots[0].details, "quartiles 9.95 to 10 ms\n100 operations, 2.5 fetches, 3 samplers a pixel\n"
                                  "knob: default\n");
  EXPECT_TRUE(plot.dots[2].dominated);
  ASSERT_EQ(plotOf(scene, Stage::preparation, Against::truth, "flip.mean").dots.size(), 1u);
  EXPECT_EQ(toSvg(plotOf(scene, Stage::preparation, Against::truth, "flip.mean")), "") << "one is no picture";
}

TEST(ParetoSvg, HasADotASettingAFrontAPathAndNamesOfTheFronts) {
  ParetoPlot plot{.timeTitle = "time", .timeUnit = "ms", .errorTitle = "FLIP", .dots = {}};
  plot.dots = {dot("highend", "default", 10, 0.2), dot("mobile", "default", 5, 0.3), dot("mobile", "x", 6, 0.4, true)};
  const std::string svg = toSvg(plot);
  EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"pareto\"")) << svg;
  EXPECT_EQ(count(svg, "<circle class=\"dot "), 3u);
  EXPECT_EQ(count(svg, "<circle class=\"dot path-1 dominated\""), 1u);
  EXPECT_EQ(count(svg, "<polyline "), 2u);
  EXPECT_EQ(count(svg, "class=\"label "), 2u);
  EXPECT_NE(svg.find("<title>mobile: x&#10;6 ms, 0.4, dominated</title>"), std::string::npos) << svg;
  EXPECT_EQ(count(svg, "style"), 0u) << "a page's policy forbids it";
  plot.namesDominated = true;
  EXPECT_EQ(count(toSvg(plot), "class=\"label "), 3u);
}

TEST(ParetoSvg, HasTicksAlsoWithinAFractionOfADecade) {
  const ParetoPlot plot{.timeTitle = "time",
                        .timeUnit = "",
                        .errorTitle = "FLIP",
                        .dots = {dot("a", "b", 7.02, 0.0001), dot("a", "c", 7.98, 0.1)}};
  const std::string svg = toSvg(plot);
  for (const char* tick : {">7<", ">7.5<", ">8<", ">0.0001<", ">0.001<", ">0.01<", ">0.1<"})
    EXPECT_EQ(count(svg, tick), tick == std::string(">7.5<") ? 0u : 1u) << tick << svg;
}

TEST(ParetoSvg, EscapesNamesAndKeepsThemApartAndWithin) {
  const std::string evil = "</title><b>";
  const ParetoPlot plot{.timeTitle = evil,
                        .timeUnit = "",
                        .errorTitle = evil,
                        .dots = {dot(evil, evil, 5, 0.3), dot(evil, evil, 5, 0.3), dot(evil, evil, 9, 0.1)}};
  const std::string svg = toSvg(plot);
  EXPECT_EQ(svg.find("<b>"), std::string::npos);
  EXPECT_NE(svg.find("text-anchor=\"end\">&lt;/title&gt;"), std::string::npos) << "the last one's stands to its left";
  std::vector<std::string> places;
  for (std::size_t at = svg.find("class=\"label "); at != std::string::npos; at = svg.find("class=\"label ", at + 1))
    places.push_back(svg.substr(svg.find(" x=", at), svg.find('>', at) - svg.find(" x=", at)));
  ASSERT_EQ(places.size(), 3u);
  EXPECT_NE(places[0], places[1]);
}

} // namespace
} // namespace parity::sweep
