// The stages of the mobile path in JSON and table: those that there are, and one that nobody has named yet.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/report.h"
#include "report/sample_report.h"
#include "report/stage.h"

namespace parity::report {
namespace {

StageResult makeStage(const char* stage, const char* through, double mean) {
  StageResult result{stage, through, makeFigures(mean, 8000, 0.9)};
  if (mean == 0) setFigure(result.figures, "flip.max", 0);
  return result;
}
StageResult makeEncoding(double mean) { return makeStage(kEncodingStage, "rgba8-gamma2", mean); }

// Of the first view's whole image and its first material.
Report makeStaged(const StageResult& glass, const StageResult& whole) {
  Report report = makeSampleReport();
  report.scenes[0].views[0].materials[0].stages.push_back(glass);
  report.scenes[0].views[0].stages.push_back(whole);
  return report;
}
Report makeReport(double glass, double whole) { return makeStaged(makeEncoding(glass), makeEncoding(whole)); }

TEST(EncodingStage, IsShownWhereThreeDigitsShowIt) {
  EXPECT_FALSE(isShown(makeEncoding(0.0004)));
  EXPECT_TRUE(isShown(makeEncoding(0.0006)));
  EXPECT_TRUE(isShown(makeEncoding(NAN)));
}

TEST(Stages, StandInTheJsonByMaterialAndWhole) {
  for (const auto& [stage, through] : {std::pair(kEncodingStage, "rgba8-gamma2"), std::pair(kTexturesStage, "astc6x6"),
                                       std::pair("upscaling", "a bicubic of half size")}) {
    const Report report = makeStaged(makeStage(stage, through, 0.04), makeStage(stage, through, 0.02));
    const auto view = nlohmann::json::parse(toJson(report)).at("/scenes/0/views/0"_json_pointer);
    const auto& glass = view.at("materials").at(0).at("stages");
    ASSERT_EQ(glass.size(), 1u);
    EXPECT_EQ(glass.at(0).at("stage"), stage);
    EXPECT_EQ(glass.at(0).at("through"), through);
    EXPECT_EQ(glass.at(0).at("figures").at("metrics").at("flip.mean"), 0.04);
    EXPECT_EQ(view.at("whole").at("stages").at(0).at("figures").at("metrics").at("flip.mean"), 0.02);
    EXPECT_TRUE(view.at("materials").at(1).at("stages").empty());
  }
}

TEST(EncodingStage, IsAColumnOfTheTableWhereItIsNotable) {
  const std::string table = toTable(makeReport(0.037, 0.021), {}, {.all = true});
  EXPECT_NE(table.find(" target "), std::string::npos) << table;
  EXPECT_NE(table.find("storing the colour of mobile in rgba8-gamma2"), std::string::npos);
  const auto lineOf = [&](const char* name) {
    const std::size_t at = table.find(name);
    return table.substr(at, table.find('\n', at) - at);
  };
  EXPECT_NE(lineOf("Glass").find(" 0.037 "), std::string::npos) << lineOf("Glass");
  EXPECT_NE(lineOf("whole image").find(" 0.021 "), std::string::npos) << lineOf("whole image");
  EXPECT_NE(lineOf("Rough metal").find("     - "), std::string::npos) << "not measured: " << lineOf("Rough metal");
  EXPECT_EQ(toTable(makeReport(0.0001, 0), {}, {.all = true}), toTable(makeSampleReport(), {}, {.all = true}));
}

// Whoever asks what compression costs wants to see that it costs nothing, too.
TEST(TexturesStage, IsAColumnOfTheTableWhateverItIs) {
  for (const double mean : {0.037, 0.0}) {
    const StageResult stage = makeStage(kTexturesStage, "astc6x6", mean);
    const std::string table = toTable(makeStaged(stage, stage), {}, {.all = true});
    EXPECT_NE(table.find("  textures  "), std::string::npos) << table;
    EXPECT_NE(table.find("the textures of mobile as astc6x6"), std::string::npos) << table;
    const std::size_t at = table.find("Glass");
    EXPECT_NE(table.substr(at, table.find('\n', at) - at).find(mean > 0 ? "   0.037 " : "   0.000 "), std::string::npos)
        << table;
  }
  EXPECT_EQ(toTable(makeSampleReport(), {}, {.all = true}).find("textures"), std::string::npos);
}

// A third stage needs no words of its own.
TEST(Stages, OneThatNobodyNamedIsAColumnBesideTheOthers) {
  Report report = makeReport(0.037, 0.021);
  for (std::vector<StageResult>* stages :
       {&report.scenes[0].views[0].materials[0].stages, &report.scenes[0].views[0].stages})
    stages->push_back(makeStage("upscaling", "a bicubic of half size", 0.052));
  const std::string table = toTable(report, {}, {.all = true});
  EXPECT_NE(table.find("  target  upscaling  "), std::string::npos) << table;
  EXPECT_NE(table.find("upscaling: mean FLIP caused only by a bicubic of half size.\n"), std::string::npos);
  const std::size_t at = table.find("Glass");
  EXPECT_NE(table.substr(at, table.find('\n', at) - at).find(" 0.037      0.052 "), std::string::npos) << table;
}

} // namespace
} // namespace parity::report
