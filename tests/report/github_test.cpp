// GitHub annotations: one command a row that is not well, and names that cannot become commands.
#include <algorithm>

#include <gtest/gtest.h>

#include "base/lines_of.h"
#include "compare/verdict/budget.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

using tests::linesOf;

TEST(GithubAnnotations, EachRowThatIsNotWellIsOneCommandTheGravestFirst) {
  const auto lines = linesOf(toGithubAnnotations(makeSampleReport(), "/checkout"));
  // Broken; of both views Rough metal, Shade, the panel that is white, the rivet that is too small, and Screw, which
  // none shows.
  ASSERT_EQ(lines.size(), 11u);
  EXPECT_EQ(lines[0],
            "::error title=parity%3A Broken::assets/Broken.glb: chunk 0: length 4096 runs past the end of the file");
  EXPECT_EQ(
      lines[1],
      "::error title=parity%3A Rough metal (Lamp%2C view front)::fail: mean FLIP 0.270 is above 0.200; 95th percentile "
      "of FLIP 0.675 is above 0.500%0Amobile is 0.5 EV darker%0ACause: skySpecular (reflections of the environment): "
      "FLIP 0.270 -> 0.061 with the high-end term");
  EXPECT_EQ(lines[3].find("::warning title=parity%3A Shade%2C cloth (Lamp%2C view front)::warn: "), 0u) << lines[3];
  EXPECT_EQ(lines[5].find("::warning title=parity%3A Lit panel (Lamp%2C view front)::not judged: "), 0u) << lines[5];
  EXPECT_EQ(lines[7].find("::warning title=parity%3A Rivet (Lamp%2C view front)::too small: 12 pixels, fewer "), 0u)
      << lines[7];
  EXPECT_EQ(lines[9], "::warning title=parity%3A Screw (Lamp%2C view front)::not seen: no view shows it");
}

TEST(GithubAnnotations, AReportThatIsWellHasNone) {
  Report report = makeSampleReport();
  report.scenes.pop_back();
  std::vector<ViewResult>& views = report.scenes[0].views;
  views.pop_back();
  views[0].materials = {views[0].materials[0], views[0].materials[4]}; // Glass, Bulb
  settleVerdicts(report);
  ASSERT_EQ(report.verdict, compare::Verdict::pass);
  EXPECT_EQ(toGithubAnnotations(report, "/checkout"), "");
}

TEST(GithubAnnotations, NothingComparedAndABaselineWithoutUseAreErrors) {
  Report report;
  report.baseline = BaselineSummary{
      "report.json", "", "", 0, {{"Desk", "", ""}}, "no material of this run is visible in the baseline"};
  report.warnings = {"b.toml: a rule judges nothing"};
  settleVerdicts(report);
  const auto lines = linesOf(toGithubAnnotations(report, "/checkout"));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "::error title=parity::nothing was compared");
  EXPECT_EQ(lines[1], "::error title=parity%3A baseline::no material of this run is visible in the baseline");
  EXPECT_EQ(lines[2].find("::warning title=parity%3A baseline::gone: scene Desk"), 0u);
  EXPECT_EQ(lines[3], "::warning title=parity::b.toml: a rule judges nothing");
}

TEST(GithubAnnotations, PointAtTheRuleThatJudgedWhereItLiesInTheCheckout) {
  Report report = makeSampleReport();
  report.scenes.pop_back();
  const auto firstLine = [&](const std::string& file) {
    compare::AppliedRule& rule = report.scenes[0].views[0].materials[1].rule;
    rule = {"b.toml, line 7", "night scene", "lighting", false, 64, file, 7};
    return linesOf(toGithubAnnotations(report, "/checkout")).at(0);
  };
  EXPECT_EQ(firstLine("ci/b.toml").find("::error file=ci/b.toml,line=7,title="), 0u) << firstLine("ci/b.toml");
  EXPECT_EQ(firstLine("/checkout/ci/b.toml").find("::error file=ci/b.toml,line=7,title="), 0u);
  EXPECT_EQ(firstLine("ci/../a,b:c%.toml").find("::error file=a%2Cb%3Ac%25.toml,line=7,title="), 0u);
  EXPECT_EQ(firstLine("/elsewhere/b.toml").find("::error title="), 0u) << "GitHub knows no file outside the checkout";
  EXPECT_EQ(firstLine("../b.toml").find("::error title="), 0u);
  EXPECT_TRUE(firstLine("ci/b.toml").ends_with("%0AReason for the budget: night scene%0AOwner: lighting"));
}

// The runner takes any line that begins with "::" as a command, and ends a property at ',' and the title at "::".
TEST(GithubAnnotations, HostileNamesAreOnlyEverNames) {
  std::vector<std::string> names = hostileNames();
  names.insert(names.begin() + 1,
               {"::error::fake", "a\n::set-output name=x::y", "100%0A::debug::z", "a,file=/etc/x,b:c"});
  Report report = makeSampleReport(names);
  for (ViewResult& view : report.scenes[0].views)
    for (MaterialResult& material : view.materials)
      material.rule = {names[2], names[2], names[3], false, 64, names[4], 1};
  report.warnings = {names[2]};
  report.scenes[1].error = "x\r\n::warning::y";
  const std::string text = toGithubAnnotations(report, "/checkout");
  for (const char c : text) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 && c != '\n') << static_cast<int>(c);
  EXPECT_EQ(text.find("\xE2\x80\xAE"), std::string::npos); // right-to-left override
  const auto lines = linesOf(text), harmless = linesOf(toGithubAnnotations(makeSampleReport(), "/checkout"));
  EXPECT_EQ(lines.size(), harmless.size() + 1);
  for (const std::string& line : lines) {
    EXPECT_TRUE(line.starts_with("::error ") || line.starts_with("::warning ")) << line;
    // Properties: a ',' or ':' of a name is escaped, so there are as many as were meant.
    const std::string properties = line.substr(line.find(' ') + 1, line.find("::", 2) - line.find(' ') - 1);
    EXPECT_LE(std::ranges::count(properties, ','), 2) << line;
    EXPECT_EQ(properties.find(':'), std::string::npos) << line;
  }
  EXPECT_NE(text.find("x%0D%0A::warning::y"), std::string::npos);
  EXPECT_NE(text.find("100%250A"), std::string::npos);
}

} // namespace
} // namespace parity::report
