// An earlier report read back: all that matters survives, and every fault is one line with its place.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/expect_error.h"
#include "base/file.h"
#include "base/temp_folder.h"
#include "report/reader.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

using nlohmann::json;

Report readText(const std::string& text) {
  const base::TempFolder folder;
  base::writeText(folder / "report.json", text);
  return readReport(folder / "report.json");
}

// Of the sample report, spoilt.
void expectRefusal(const std::function<void(json&)>& spoil, const std::string& place, const std::string& reason) {
  json document = json::parse(toJson(makeSampleReport()));
  spoil(document);
  base::expectError([&] { readText(document.dump()); }, "report.json: " + place, reason);
}

TEST(ReportReader, FiguresAndVerdictsSurvive) {
  const Report written = makeSampleReport(), read = readText(toJson(written));
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.device, written.device);
  EXPECT_EQ(read.settings, written.settings);
  EXPECT_EQ(read.verdict, written.verdict);
  ASSERT_EQ(read.scenes.size(), 2u);
  EXPECT_EQ(read.scenes[0].environment, written.scenes[0].environment);
  EXPECT_EQ(read.scenes[0].sun, written.scenes[0].sun);
  EXPECT_EQ(read.scenes[0].light, "sky light x 1,1,0.5");
  EXPECT_EQ(read.scenes[1].light, "") << "not written";
  EXPECT_EQ(read.scenes[1].error, written.scenes[1].error);
  ASSERT_EQ(read.scenes[0].views.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v) {
    const ViewResult &view = read.scenes[0].views[v], &original = written.scenes[0].views[v];
    EXPECT_EQ(view.name, original.name);
    EXPECT_EQ(view.wholeVerdict, original.wholeVerdict);
    ASSERT_EQ(view.materials.size(), original.materials.size());
    for (std::size_t m = 0; m < view.materials.size(); ++m) {
      const MaterialResult &material = view.materials[m], &source = original.materials[m];
      EXPECT_EQ(material.name, source.name);
      EXPECT_EQ(material.verdict, source.verdict);
      EXPECT_EQ(material.figures.pixels, source.figures.pixels);
      for (const compare::Figure& figure : source.figures.values)
        EXPECT_EQ(material.figures.find(figure.name), figure.value) << figure.name; // also infinite ones
    }
  }
}

void expectSame(const std::vector<compare::Condition>& read, const std::vector<compare::Condition>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].name, written[i].name);
    EXPECT_EQ(read[i].value, written[i].value) << read[i].name;
    EXPECT_EQ(read[i].actsOn, written[i].actsOn) << read[i].name;
    EXPECT_EQ(read[i].words, written[i].words) << read[i].name;
  }
}

TEST(ReportReader, ConditionsSurviveOnEveryLevel) {
  const Report written = makeSampleReportWithTruth(), read = readText(toJson(written));
  expectSame(read.conditions, written.conditions);
  expectSame(read.scenes[0].conditions, written.scenes[0].conditions);
  expectSame(read.scenes[0].views[1].conditions, written.scenes[0].views[1].conditions);
  EXPECT_EQ(read.conditions.back().actsOn, compare::ActsOn::truth);
}

TEST(ReportReader, OfATruthOnlyWhetherItIsANumber) {
  Report written = makeSampleReportWithTruth();
  written.scenes[0].views[0].materials[1].truth->figures.nonFinite = 3;
  const Report with = readText(toJson(written)), without = readText(toJson(makeSampleReport()));
  const MaterialResult& metal = with.scenes[0].views[0].materials[1];
  EXPECT_EQ(metal.figures.find("flip.mean"), 0.27) << "not a truth's";
  EXPECT_EQ(metal.figures.find("relmse"), without.scenes[0].views[0].materials[1].figures.find("relmse"));
  ASSERT_TRUE(metal.truth);
  EXPECT_EQ(metal.truth->figures.nonFinite, 3u);
  EXPECT_TRUE(metal.truth->figures.test.values.empty());
  EXPECT_FALSE(without.scenes[0].views[0].materials[1].truth);
}

// What later versions read more of an earlier report may be absent in one of an earlier version.
TEST(ReportReader, PicturesAndClippingAreReadWhereTheyAreThere) {
  Report report = makeSampleReport();
  report.scenes[0].views[0].materials[2].figures.clippedBlack = 0.25;
  nlohmann::json document = nlohmann::json::parse(toJson(report));
  const Report full = readText(document.dump());
  EXPECT_EQ(full.scenes[0].views[0].images.test, "images/lamp_test.png");
  EXPECT_EQ(full.scenes[0].views[0].materials[1].crops.reference, "images/metal_ref.png");
  EXPECT_EQ(full.scenes[0].views[0].materials[2].notModelled, std::vector<std::string>{"sheen"});
  EXPECT_EQ(full.scenes[0].views[0].materials[2].figures.clippedBlack, 0.25);
  nlohmann::json& view = document["scenes"][0]["views"][0];
  view.erase("images");
  view["materials"][1].erase("crops");
  view["materials"][2].erase("notModelled");
  view["materials"][2]["figures"].erase("clippedBlack");
  const Report bare = readText(document.dump());
  EXPECT_EQ(bare.scenes[0].views[0].images.test, "");
  EXPECT_EQ(bare.scenes[0].views[0].materials[1].crops.reference, "");
  EXPECT_TRUE(bare.scenes[0].views[0].materials[2].notModelled.empty());
}

TEST(ReportReader, ANullThatIsNotIdentityIsNotANumber) {
  Report report = makeSampleReport();
  setFigure(report.scenes[0].views[0].whole, "rmse", NAN);
  EXPECT_TRUE(std::isnan(*readText(toJson(report)).scenes[0].views[0].whole.find("rmse")));
}

TEST(ReportReader, TakesTheFolderToo) {
  const base::TempFolder folder;
  base::writeText(folder / "report.json", toJson(makeSampleReport()));
  EXPECT_EQ(readReport(folder.path()).scenes.size(), 2u);
}

TEST(ReportReader, OtherSchemasAreRefusedInWords) {
  expectRefusal([](json& d) { d["schema"] = kReportSchema + 1; }, "/schema", "a newer version of parity");
  expectRefusal([](json& d) { d["schema"] = kOldestRead - 1; }, "/schema", "an older version of parity");
  expectRefusal([](json& d) { d["schema"] = "3"; }, "/schema", "is not a whole number");
  expectRefusal([](json& d) { d.erase("schema"); }, "/", "lacks 'schema'");
}

// Of schema 3 each material and whole image had its stages under names of their own, of which no later run asks.
TEST(ReportReader, AReportOfSchema3IsStillABaseline) {
  json document = json::parse(toJson(makeSampleReport()));
  document["schema"] = 3;
  json& whole = document["scenes"][0]["views"][0]["whole"];
  whole.erase("stages");
  whole["encoding"] = {{"target", "rgba16f"}, {"figures", nullptr}};
  EXPECT_EQ(readText(document.dump()).scenes[0].views[0].whole.find("flip.mean"),
            makeSampleReport().scenes[0].views[0].whole.find("flip.mean"));
}

// A baseline of before: its figures were of two regions, so that none of it may be read as if it were of one.
TEST(ReportReader, AReportOfTwoRegionsIsOneLineThatSaysWhatToDo) {
  expectRefusal(
      [](json& d) {
        d["schema"] = 2;
        json& figures = d["scenes"][0]["views"][0]["whole"]["figures"];
        figures = {{"interior", figures}, {"all", figures}};
      },
      "/schema", "is 2, from an older version of parity; this one reads 3 to 4; make the report again");
  expectRefusal(
      [](json& d) {
        json& figures = d["scenes"][0]["views"][0]["whole"]["figures"];
        figures = {{"interior", figures}, {"all", figures}};
      },
      "/scenes/0/views/0/whole/figures", "lacks 'pixels'");
}

TEST(ReportReader, EveryFaultIsNamedWithItsPlace) {
  expectRefusal([](json& d) { d["scenes"][0]["views"][1].erase("whole"); }, "/scenes/0/views/1", "lacks 'whole'");
  expectRefusal([](json& d) { d["scenes"][0]["views"] = 3; }, "/scenes/0/views", "is not a list");
  expectRefusal([](json& d) { d["scenes"][0]["name"] = nullptr; }, "/scenes/0/name", "is not a string");
  expectRefusal([](json& d) { d["verdict"] = "fine"; }, "/verdict", "'fine' is not a verdict");
  expectRefusal([](json& d) { d["scenes"][0]["views"][0]["whole"]["figures"]["pixels"] = -1; },
                "/scenes/0/views/0/whole/figures/pixels", "at least 0");
  expectRefusal([](json& d) { d["scenes"][0]["views"][0]["whole"]["figures"]["metrics"]["rmse"] = "0.1"; },
                "/scenes/0/views/0/whole/figures/metrics/rmse", "is not a number");
  expectRefusal([](json& d) { d["settings"] = json::array({7}); }, "/settings/0", "is not an object");
  expectRefusal([](json& d) { d.erase("conditions"); }, "/", "lacks 'conditions'");
  expectRefusal([](json& d) { d["scenes"][0]["views"][0]["conditions"] = "none"; }, "/scenes/0/views/0/conditions",
                "is not a list");
  expectRefusal([](json& d) { d["scenes"][0]["conditions"][1]["value"] = 90; }, "/scenes/0/conditions/1/value",
                "is not a string");
  expectRefusal([](json& d) { d["conditions"][0]["actsOn"] = "taste"; }, "/conditions/0/actsOn",
                "'taste' is not what a condition acts on");
}

// What is wrong with the whole report is said before what is wrong with a scene, wherever they stand in the file.
TEST(ReportReader, TheOrderOfKeysDoesNotMatter) {
  nlohmann::ordered_json document = nlohmann::ordered_json::parse(toJson(makeSampleReport())), turned;
  for (auto item = document.rbegin(); item != document.rend(); ++item) turned[item.key()] = item.value();
  ASSERT_EQ(turned.begin().key(), "scenes");
  EXPECT_EQ(readText(turned.dump()).scenes.size(), 2u);
  turned["scenes"][0]["name"] = 7;
  base::expectError([&] { readText(turned.dump()); }, "report.json: /scenes/0/name", "is not a string");
  turned["schema"] = 2;
  base::expectError([&] { readText(turned.dump()); }, "report.json: /schema", "is 2");
}

TEST(ReportReader, ScenesThatAreNoListAreRefused) {
  expectRefusal([](json& d) { d["scenes"] = 3; }, "/scenes", "is not a list");
  expectRefusal([](json& d) { d["scenes"] = json::object(); }, "/scenes", "is not a list");
  expectRefusal([](json& d) { d.erase("scenes"); }, "/", "lacks 'scenes'");
  expectRefusal([](json& d) { d["scenes"][1] = json::array(); }, "/scenes/1", "is not an object");
}

TEST(ReportReader, WhatIsNotReadMayBeAnything) {
  json document = json::parse(toJson(makeSampleReport()));
  document["warnings"] = {{"scenes", {1, {2}}}};
  document["further"] = {{{"deep", {{"name", {}}}}}, 3};
  document["scenes"][0]["views"][0]["materials"][0]["notes"] = {{"name", 3}};
  EXPECT_EQ(readText(document.dump()).scenes.size(), 2u);
}

TEST(ReportReader, WhatIsNoReportIsRefused) {
  base::expectError([] { readText("{ \"schema\": "); }, "report.json: byte 13", "is not JSON");
  base::expectError([] { readText(""); }, "report.json: byte 1", "is not JSON");
  base::expectError([] { readText("[]"); }, "report.json: /", "is not an object");
  base::expectError([] { readText(std::string(100000, '[')); }, "report.json: byte", "is not JSON");
  const base::TempFolder folder;
  base::expectError([&] { readReport(folder / "none.json"); }, "none.json", "does not exist");
  base::expectError([&] { readReport(folder.path()); }, "report.json", "does not exist");
}

} // namespace
} // namespace parity::report
