// report.json and run.json: order, numbers, nulls, names; and that equal reports are equal bytes.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text/json_writer.h"
#include "report/report.h"
#include "report/sample_report.h"

namespace parity::report {
namespace {

using nlohmann::ordered_json;

std::string numberText(double value) {
  base::JsonWriter json;
  json.number(value);
  return json.finish();
}

TEST(ReportJson, EqualReportsAreEqualBytes) {
  EXPECT_EQ(toJson(makeSampleReport()), toJson(makeSampleReport()));
  EXPECT_NE(toJson(makeSampleReport()), toJson(makeSampleReport({"Another name"})));
}

TEST(ReportJson, PiecesAreTheSameBytes) {
  Report report = makeSampleReport();
  while (report.scenes.size() < 40) report.scenes.push_back(report.scenes.front());
  for (const base::JsonLayout layout : {base::JsonLayout::indented, base::JsonLayout::compact}) {
    std::string text;
    std::size_t longest = 0, count = 0;
    const auto sink = [&](std::string_view piece) {
      text += piece;
      longest = std::max(longest, piece.size());
      ++count;
    };
    writeJson(report, sink, layout);
    EXPECT_EQ(text, toJson(report, layout));
    EXPECT_GT(count, 5u);
    EXPECT_LT(longest, 70000u);
  }
}

TEST(ReportJson, TheHeadAndTheScenesAreTheReport) {
  const Report report = makeSampleReport();
  ordered_json document = ordered_json::parse(headJson(report));
  EXPECT_FALSE(document.contains("scenes"));
  for (const SceneResult& scene : report.scenes) document["scenes"].push_back(ordered_json::parse(toJson(scene)));
  EXPECT_EQ(document, ordered_json::parse(toJson(report)));
}

TEST(ReportJson, KeysStandInAFixedOrder) {
  const ordered_json document = ordered_json::parse(toJson(makeSampleReport()));
  const auto keys = [](const ordered_json& object) {
    std::string names;
    for (const auto& [key, value] : object.items()) names += (names.empty() ? "" : " ") + key;
    return names;
  };
  EXPECT_EQ(keys(document),
            "schema tool version suite device verdict headline counts wholeCounts displayTable problems warnings "
            "baseline settings conditions digests statistics scenes");
  EXPECT_EQ(keys(document["scenes"][0]),
            "name source environment sun light conditions inputs verdict error warnings views passes permutations");
  EXPECT_EQ(keys(document["scenes"][0]["views"][0]),
            "name reference test width height conditions verdict whole materials images exposureEv pixels");
  EXPECT_EQ(
      keys(document["scenes"][0]["views"][0]["materials"][0]),
      "name verdict reason seenElsewhere bias figures checks budget baseline notModelled notes terms crops stages");
}

TEST(ReportJson, HoldsWhatTheReportHolds) {
  const ordered_json document = ordered_json::parse(toJson(makeSampleReport()));
  EXPECT_EQ(document["schema"], 4);
  EXPECT_EQ(document["verdict"], "error");
  EXPECT_EQ(document["counts"],
            ordered_json::parse(R"({"pass":3,"notSeen":2,"tooSmall":2,"notJudged":2,"warn":2,"fail":2,"error":0})"));
  EXPECT_EQ(document["settings"][2], ordered_json::parse(R"({"name":"preset","value":"ue4-2020"})"));
  EXPECT_EQ(document["conditions"][1].dump(), R"({"name":"materials","value":"all","actsOn":"whole images"})");
  EXPECT_EQ(document["conditions"][2]["words"], "4 SH coefficients");
  EXPECT_EQ(document["scenes"][0]["conditions"][1]["name"], "environment rotation");
  EXPECT_EQ(document["scenes"][0]["views"][0]["conditions"][1]["value"], "45");
  EXPECT_EQ(document["scenes"][1]["error"]["exitCode"], 4);
  EXPECT_TRUE(document["scenes"][0]["error"].is_null());
  const ordered_json& view = document["scenes"][0]["views"][0];
  EXPECT_EQ(view["whole"]["figures"]["pixels"], 400000);
  EXPECT_EQ(document["scenes"][0]["passes"], ordered_json::parse(R"([
    {"name": "surface", "count": 800000, "unit": "samples", "skipped": null},
    {"name": "local lights", "count": 0, "unit": "lights", "skipped": "no local lights"}])"));
  const ordered_json& metal = view["materials"][1];
  EXPECT_EQ(metal["name"], "Rough metal");
  EXPECT_EQ(metal["verdict"], "fail");
  const ordered_json& figures = metal["figures"];
  EXPECT_EQ(figures["pixels"], 120000);
  EXPECT_EQ(figures["metrics"]["flip.mean"], 0.27);
  EXPECT_EQ(figures["clippedBlack"], 0.01);
  EXPECT_EQ(figures["clippedWhite"], 0.02);
  EXPECT_EQ(figures["referenceLuma"], 0.42);
  EXPECT_EQ(figures["testLuma"], 0.42 * 0.71);
  EXPECT_EQ(figures["referenceLuminance"], 0.15);
  EXPECT_EQ(figures["testLuminance"], 0.15 * 0.71);
  EXPECT_EQ(metal["checks"][0]["metric"], "flip.mean");
  EXPECT_EQ(metal["checks"][0]["fail"], 0.2);
  EXPECT_EQ(metal["terms"][1]["term"], "sunSpecular");
  EXPECT_EQ(metal["terms"][1]["test"], 0.11);
  EXPECT_EQ(metal["attribution"], ordered_json::parse(R"({"flip":0.27,"terms":[
    {"term":"sunSpecular","flip":0.264},{"term":"skySpecular","flip":0.061}]})"));
  EXPECT_EQ(metal["crops"]["flip"], "images/metal_flip.png");
  EXPECT_EQ(metal["budget"]["rule"], "built-in");
  EXPECT_EQ(metal["budget"]["minPixels"], 64);
  EXPECT_EQ(metal["notModelled"], ordered_json::array());
  EXPECT_EQ(view["materials"][2]["notModelled"], ordered_json::array({"sheen"}));
  EXPECT_EQ(view["materials"][5]["verdict"], "too small");
  EXPECT_EQ(view["materials"][6]["verdict"], "not judged");
}

TEST(ReportJson, DroppedLightsStandInTheirViewAndNowhereWithoutThem) {
  Report report = makeSampleReport();
  report.scenes[0].views[1].droppedLights = makeDroppedLights();
  const ordered_json document = ordered_json::parse(toJson(report));
  EXPECT_FALSE(document["scenes"][0]["views"][0].contains("droppedLights"));
  EXPECT_EQ(document["scenes"][0]["views"][1]["droppedLights"].dump(), ordered_json::parse(R"({"lights":5,"measured":[
    {"name":"lamp 1","kind":"spot","keptBy":0,"droppedBy":2,"materials":[
      {"name":"Glass","flip":0.02},{"name":"Rough metal","flip":0.031}]},
    {"name":"lamp 2","kind":"point","keptBy":3,"droppedBy":1,"materials":[
      {"name":"Glass","flip":0.25}]}],
    "notMeasured":["lamp 3","lamp 4"]})")
                                                                           .dump());
}

TEST(ReportJson, WhatIsNotSeenHasNoFiguresRatherThanZeros) {
  const ordered_json document = ordered_json::parse(toJson(makeSampleReport()));
  const ordered_json& screw = document["scenes"][0]["views"][0]["materials"][3];
  EXPECT_EQ(screw["verdict"], "not seen");
  EXPECT_TRUE(screw["figures"].is_null());
}

TEST(ReportJson, TheTruthStandsBesideWhatItIsOf) {
  const Report report = makeSampleReportWithTruth();
  const ordered_json document = ordered_json::parse(toJson(report)), &view = document["scenes"][0]["views"][0];
  EXPECT_EQ(view["whole"]["truth"]["images"]["truth"], "images/lamp_truth.png");
  const ordered_json& truth = view["materials"][1]["truth"];
  EXPECT_EQ(truth["figures"]["test"]["metrics"]["flip.mean"], 0.27);
  EXPECT_EQ(truth["figures"]["reference"]["metrics"]["flip.mean"], 0.27 / 3);
  EXPECT_EQ(truth["figures"]["reference"]["metrics"]["relmse"], 0.04 / 3);
  EXPECT_EQ(truth["figures"]["error"],
            ordered_json::parse(R"({"median":0.011,"worst":0.02,"relmse":0.0001,"samples":420})"));
  EXPECT_EQ(truth["figures"]["nonFinite"], 0);
  ASSERT_EQ(truth["terms"].size(), 2u);
  EXPECT_EQ(truth["terms"][1]["term"], "skySpecular");
  EXPECT_EQ(truth["terms"][1]["luminance"], ordered_json::parse(R"({"truth":0.3,"reference":0.27,"test":0.15})"));
  EXPECT_EQ(truth["terms"][1]["figures"]["reference"]["flip.mean"], 0.12);
  EXPECT_EQ(truth["terms"][1]["figures"]["test"]["relmse"], 0.034);
  EXPECT_EQ(view["materials"][0]["truth"]["notes"][0], "high-end: within 2 standard errors");
  EXPECT_TRUE(view["materials"][3]["truth"]["figures"].is_null()) << "not seen";
  EXPECT_EQ(toJson(makeSampleReport()).find("truth"), std::string::npos) << "only where it was asked for";
}

TEST(ReportJson, AnInfinitePsnrIsNull) {
  const ordered_json document = ordered_json::parse(toJson(makeSampleReport()));
  EXPECT_TRUE(document["scenes"][0]["views"][0]["materials"][4]["figures"]["metrics"]["psnr"].is_null());
  EXPECT_TRUE(document["scenes"][0]["views"][0]["materials"][0]["figures"]["metrics"]["psnr"].is_number());
}

TEST(ReportJson, NamesOfAnyBytesComeBackAsUnicode) {
  const std::vector<std::string> names = hostileNames();
  const ordered_json document = ordered_json::parse(toJson(makeSampleReport(names))); // throws on invalid UTF-8
  EXPECT_EQ(document["scenes"][0]["name"], names[0]);
  EXPECT_EQ(document["scenes"][0]["views"][0]["materials"][0]["name"], names[1]);
  EXPECT_EQ(document["scenes"][0]["views"][0]["materials"][3]["name"], "line\nbreak\tand\rreturn");
  EXPECT_EQ(document["scenes"][0]["views"][1]["name"], names[6]); // bell, zero and escape survive as \u00xx
  EXPECT_EQ(document["scenes"][1]["name"], "bad \uFFFD\uFFFD utf-8 \uFFFD\uFFFD\uFFFD");
}

TEST(ReportJson, RunInfoHoldsTimesAndNothingElseDoes) {
  const ordered_json run = ordered_json::parse(toJson(makeSampleRun()));
  EXPECT_EQ(run["startedAt"], "2024-05-01T12:00:00Z");
  EXPECT_EQ(run["commandLine"], "parity report Lamp.gltf -o out");
  EXPECT_EQ(run["timings"][0]["stage"], "load");
  EXPECT_EQ(run["timings"][0]["timeMs"], 120.5);
  EXPECT_EQ(run["sceneTimes"], ordered_json::array());
  RunInfo timed = makeSampleRun();
  timed.sceneTimes = {{"Lamp", 1.5}};
  EXPECT_EQ(ordered_json::parse(toJson(timed))["sceneTimes"].dump(),
            R"([{"scene":"Lamp","seconds":1.5,"cpuSeconds":0}])");
  EXPECT_EQ(toJson(makeSampleReport()).find("2024-05-01"), std::string::npos);
}

TEST(JsonWriter, NumbersAreTheShortestThatReadBackTheSame) {
  EXPECT_EQ(numberText(0.1), "0.1\n");
  EXPECT_EQ(numberText(0.1 + 0.2), "0.30000000000000004\n");
  EXPECT_EQ(numberText(1), "1\n");
  EXPECT_EQ(numberText(1e300), "1e+300\n");
  EXPECT_EQ(numberText(5e-324), "5e-324\n");
  EXPECT_EQ(numberText(9007199254740993.0), "9007199254740992\n");
  for (const double value : {1.0 / 3, 0.142857, 6.02214076e23, -2.5e-7, std::numeric_limits<double>::max()})
    EXPECT_EQ(nlohmann::json::parse(numberText(value)).get<double>(), value);
}

TEST(JsonWriter, WhatIsNotFiniteIsNull) {
  EXPECT_EQ(numberText(NAN), "null\n");
  EXPECT_EQ(numberText(INFINITY), "null\n");
  EXPECT_EQ(numberText(-INFINITY), "null\n");
}

TEST(JsonWriter, WritesNestedValuesAsRfc8259SaysIt) {
  base::JsonWriter json;
  json.beginObject();
  json.key("empty").beginArray();
  json.endArray();
  json.key("list").beginArray();
  json.integer(-3);
  json.boolean(true);
  json.null();
  json.endArray();
  json.key("a\"b\\\n").text("\x01/");
  json.endObject();
  EXPECT_EQ(json.finish(), "{\n  \"empty\": [],\n  \"list\": [\n    -3,\n    true,\n    null\n  ],\n"
                           "  \"a\\\"b\\\\\\u000a\": \"\\u0001/\"\n}\n");
}

TEST(JsonWriter, CompactIsTheSameWithoutSpaces) {
  const Report report = makeSampleReport(hostileNames());
  const std::string compact = toJson(report, base::JsonLayout::compact);
  EXPECT_EQ(nlohmann::ordered_json::parse(compact), nlohmann::ordered_json::parse(toJson(report)));
  EXPECT_EQ(compact.find('\n'), compact.size() - 1);
  base::JsonWriter json(base::JsonLayout::compact);
  json.beginObject();
  json.key("a").beginArray();
  json.integer(1);
  json.number(0.1);
  json.endArray();
  json.key("b").null();
  json.endObject();
  EXPECT_EQ(json.finish(), "{\"a\":[1,0.1],\"b\":null}\n");
}

} // namespace
} // namespace parity::report
