// --interreflection of the truth as a user turns it on: what it adds, where the report says so, what is refused.
#include "base/image/image_io.h"
#include "cli/checks.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

class InterreflectionTest : public RenderingTest {
protected:
  base::Image render(const std::string& file, const std::vector<std::string>& more) const {
    return RenderingTest::render("builtin:room", "reference",
                                 join({{"--size", "16x12", "--error", "20%", "--terms"}, more}), file);
  }
  nlohmann::json report(const std::vector<std::string>& more) const {
    const RunResult result =
        runParity(join({{"report", "-o", path("out"), "--size", "16x12", "--error", "30%"}, more}));
    EXPECT_TRUE(isReported(result)) << result.err;
    return readReport(m_folder / "out");
  }
};

TEST_F(InterreflectionTest, AddsLightToTheTermsOfTheSkyAlone) {
  const std::vector<std::string> cache = {"--cache", path("cache")};
  const base::Image shadows = render("shadows.exr", join({cache, {"--shadows"}}));
  render("none.exr", join({cache, {"--shadows", "--interreflection", "0"}}));
  EXPECT_EQ(readWholeFile(m_folder / "none.exr"), readWholeFile(m_folder / "shadows.exr"));
  const base::Image one = render("one.exr", join({cache, {"--interreflection", "1"}}));
  const base::Image three = render("three.exr", join({cache, {"--interreflection", "3"}}));
  for (const shading::Term t : {shading::Term::sunDiffuse, shading::Term::localSpecular, shading::Term::emissive})
    EXPECT_EQ(sumOf(one, channelOf(t)), sumOf(shadows, channelOf(t))) << "also without --shadows";
  const int diffuse = channelOf(shading::Term::skyDiffuse), specular = channelOf(shading::Term::skySpecular);
  EXPECT_GT(sumOf(one, diffuse), 2 * sumOf(shadows, diffuse)) << "a room with one window";
  EXPECT_GT(sumOf(one, specular), 1.3 * sumOf(shadows, specular));
  EXPECT_GT(sumOf(three, diffuse), 1.1 * sumOf(one, diffuse));
  // From the cache, and by one thread anew, it is the same.
  render("again.exr", join({cache, {"--interreflection", "3"}}));
  EXPECT_EQ(readWholeFile(m_folder / "again.exr"), readWholeFile(m_folder / "three.exr"));
  render("anew.exr", {"--no-cache", "--threads", "1", "--interreflection", "3"});
  EXPECT_EQ(readWholeFile(m_folder / "anew.exr"), readWholeFile(m_folder / "three.exr"));
}

TEST_F(InterreflectionTest, TheReportSaysSo) {
  const nlohmann::json json = report({"builtin:room", "--truth", "--interreflection", "2"});
  std::string truth;
  for (const nlohmann::json& setting : json["settings"])
    if (setting["name"] == "truth") truth = setting["value"];
  EXPECT_TRUE(contains(truth, ", with shadows, 2 bounces between surfaces,")) << truth;
  EXPECT_TRUE(contains(json["scenes"][0].value("light", ""), "2 bounces between surfaces in the truth"));
}

TEST_F(InterreflectionTest, OfASuiteIsASceneS) {
  const auto suite = [&](const std::string& line) {
    writeFile(m_folder / "suite.toml", "[[scene]]\nfile = \"builtin:room\"\n" + line);
    return std::vector<std::string>{"--suite", path("suite.toml"), "--truth"};
  };
  EXPECT_TRUE(contains(report(suite("interreflection = 1\n"))["scenes"][0].value("light", ""),
                       "1 bounce between surfaces in the truth"));
  EXPECT_FALSE(contains(
      report(join({suite("interreflection = 0\n"), {"--interreflection", "1"}}))["scenes"][0].value("light", ""),
      "bounce"));
  for (const char* bad : {"-1", "65", "1.5", "true", "\"two\"", "nan", "1e300"})
    expectRefused(runParity(join({{"report", "-o", path("x")}, suite(std::string("interreflection = ") + bad + "\n")})),
                  4, {"suite.toml", "line 3", "interreflection"});
}

TEST_F(InterreflectionTest, WhatHasNoSenseIsRefusedInOneLine) {
  const auto refused = [](const RunResult& result, const std::string& part) {
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_TRUE(contains(linesOf(result.err).at(0), part)) << result.err;
  };
  for (const char* bad : {"-1", "65", "1000000000000", "1.5", "x", "", "nan"})
    refused(runParity({"render", "builtin:room", "--path", "reference", "-o", path("x.exr"),
                       std::string("--interreflection=") + bad}),
            "--interreflection");
  refused(runParity({"diff", "builtin:room", "--interreflection", "1"}), "--interreflection requires --truth");
  expectRefused(
      runParity({"render", "builtin:room", "--path", "highend", "-o", path("x.exr"), "--interreflection", "1"}), 64,
      {"--interreflection", "only --path truth"});
}

} // namespace
} // namespace parity::tests
