// The stage `encoding` in words, JSON, page and table.
#include <nlohmann/json.hpp>

#include "compare/encoding.h"
#include "compare/html_reader.h"
#include "compare/report.h"
#include "compare/sample_report.h"

namespace parity::compare {
namespace {

// mean: of the interior.
Encoding makeStage(double mean, std::uint64_t pixels = 8000) {
  Encoding stage{"rgba8-gamma2", makeRegion("stage", mean, pixels, 0.9)};
  if (mean == 0) setFigure(stage.figures, "flip.max", 0);
  return stage;
}

Report makeReport(double glass, double whole) {
  Report report = makeSampleReport();
  report.scenes[0].views[0].materials[0].encoding = makeStage(glass);
  report.scenes[0].views[0].encoding = makeStage(whole);
  return report;
}

TEST(EncodingStage, isSaidInWords) {
  EXPECT_EQ(describeEncoding(makeStage(0.04), false),
            "stored in rgba8-gamma2: FLIP 0.040 on average, 0.100 p95, 0.160 at most; it is 10.0 % darker");
  EXPECT_EQ(describeEncoding(makeStage(0.04), true).substr(0, 36), "stored in rgba8-gamma2: FLIP 0.044 o") << "of all";
  EXPECT_EQ(describeEncoding(makeStage(0), false), "stored in rgba8-gamma2: no difference");
  EXPECT_EQ(describeEncoding(makeStage(0.04, 0), false), "") << "no pixels";
  EXPECT_EQ(describeEncoding(std::nullopt, true), "");
  Encoding broken = makeStage(0);
  broken.figures.interior.nonFinite = 3;
  EXPECT_NE(describeEncoding(broken, false).find("NaN or infinite"), std::string::npos) << "never 'no difference'";
}

TEST(EncodingStage, isNotableWhereThreeDigitsShowIt) {
  EXPECT_FALSE(isNotable(std::nullopt));
  EXPECT_FALSE(isNotable(makeStage(0.0004)));
  EXPECT_TRUE(isNotable(makeStage(0.0006)));
  EXPECT_TRUE(isNotable(makeStage(NAN)));
}

TEST(EncodingStage, standsInTheJsonByMaterialAndWhole) {
  const auto view = nlohmann::json::parse(toJson(makeReport(0.04, 0.02))).at("/scenes/0/views/0"_json_pointer);
  const auto& stage = view.at("materials").at(0).at("encoding");
  EXPECT_EQ(stage.at("target"), "rgba8-gamma2");
  EXPECT_EQ(stage.at("figures").at("interior").at("metrics").at("flip.mean"), 0.04);
  EXPECT_EQ(view.at("whole").at("encoding").at("figures").at("interior").at("metrics").at("flip.mean"), 0.02);
  EXPECT_FALSE(view.at("materials").at(1).contains("encoding"));
}

TEST(EncodingStage, standsOnThePage) {
  const auto document = parse(toHtml(makeReport(0.04, 0), makeSampleRun()));
  const auto lines = select(document, "//section[@id='scene-1-view-1']//p[@class='aside encoding']");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_STREQ(lines[0].node().text().get(), "Mobile stored in rgba8-gamma2: no difference.");
  EXPECT_EQ(std::string(lines[1].node().text().get()).substr(0, 41), "Mobile stored in rgba8-gamma2: FLIP 0.040");
  const auto plain = parse(toHtml(makeSampleReport(), makeSampleRun()));
  EXPECT_EQ(select(plain, "//p[@class='aside encoding']").size(), 0u);
}

TEST(EncodingStage, isAColumnOfTheTableWhereItIsNotable) {
  const std::string table = toTable(makeReport(0.037, 0.021), false);
  EXPECT_NE(table.find(" target "), std::string::npos) << table;
  EXPECT_NE(table.find("storing mobile's colour in rgba8-gamma2"), std::string::npos);
  const auto lineOf = [&](const char* name) {
    const std::size_t at = table.find(name);
    return table.substr(at, table.find('\n', at) - at);
  };
  EXPECT_NE(lineOf("Glass").find(" 0.037 "), std::string::npos) << lineOf("Glass");
  EXPECT_NE(lineOf("whole image").find(" 0.023 "), std::string::npos) << "all pixels: " << lineOf("whole image");
  EXPECT_NE(lineOf("Rough metal").find("     - "), std::string::npos) << "not measured: " << lineOf("Rough metal");
  EXPECT_EQ(toTable(makeReport(0.0001, 0), false), toTable(makeSampleReport(), false));
}

} // namespace
} // namespace parity::compare
