// The stages `encoding` and `textures` in JSON and table.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compare/encoding.h"
#include "compare/report.h"
#include "compare/sample_report.h"

namespace parity::compare {
namespace {

Encoding makeStage(double mean, std::uint64_t pixels = 8000) {
  Encoding stage{"rgba8-gamma2", makeFigures(mean, pixels, 0.9)};
  if (mean == 0) setFigure(stage.figures, "flip.max", 0);
  return stage;
}

Report makeReport(double glass, double whole) {
  Report report = makeSampleReport();
  report.scenes[0].views[0].materials[0].encoding = makeStage(glass);
  report.scenes[0].views[0].encoding = makeStage(whole);
  return report;
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
  EXPECT_EQ(stage.at("figures").at("metrics").at("flip.mean"), 0.04);
  EXPECT_EQ(view.at("whole").at("encoding").at("figures").at("metrics").at("flip.mean"), 0.02);
  EXPECT_FALSE(view.at("materials").at(1).contains("encoding"));
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
  EXPECT_NE(lineOf("whole image").find(" 0.021 "), std::string::npos) << lineOf("whole image");
  EXPECT_NE(lineOf("Rough metal").find("     - "), std::string::npos) << "not measured: " << lineOf("Rough metal");
  EXPECT_EQ(toTable(makeReport(0.0001, 0), false), toTable(makeSampleReport(), false));
}

Report makeCompressed(double glass, double whole) {
  Report report = makeSampleReport();
  report.scenes[0].views[0].materials[0].textures = TextureCompression{"astc6x6", makeStage(glass).figures};
  report.scenes[0].views[0].textures = TextureCompression{"astc6x6", makeStage(whole).figures};
  return report;
}

TEST(TexturesStage, standsInTheJsonByMaterialAndWhole) {
  const auto view = nlohmann::json::parse(toJson(makeCompressed(0.04, 0.02))).at("/scenes/0/views/0"_json_pointer);
  const auto& stage = view.at("materials").at(0).at("textures");
  EXPECT_EQ(stage.at("block"), "astc6x6");
  EXPECT_EQ(stage.at("figures").at("metrics").at("flip.mean"), 0.04);
  EXPECT_EQ(view.at("whole").at("textures").at("figures").at("metrics").at("flip.mean"), 0.02);
  EXPECT_FALSE(view.at("materials").at(1).contains("textures"));
}

// Whoever asks what compression costs wants to see that it costs nothing, too.
TEST(TexturesStage, isAColumnOfTheTableWhateverItIs) {
  for (const double mean : {0.037, 0.0}) {
    const std::string table = toTable(makeCompressed(mean, mean), false);
    EXPECT_NE(table.find("  textures  "), std::string::npos) << table;
    EXPECT_NE(table.find("mobile's textures in astc6x6"), std::string::npos) << table;
    const std::size_t at = table.find("Glass");
    EXPECT_NE(table.substr(at, table.find('\n', at) - at).find(mean > 0 ? "   0.037 " : "   0.000 "), std::string::npos)
        << table;
  }
  EXPECT_EQ(toTable(makeSampleReport(), false).find("textures"), std::string::npos);
}

} // namespace
} // namespace parity::compare
