// report.json against its committed schema, and the validator against documents of known validity.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "base/file.h"
#include "compare/verdict/budget.h"
#include "report/judge.h"
#include "report/record/generated.h"
#include "report/report.h"
#include "report/sample_report.h"
#include "report/schema_validator.h"

namespace parity::report {
namespace {

using nlohmann::json;

json loadSchema() { return json::parse(base::readText(std::string(PARITY_SOURCE_DIR) + "/report/report.schema.json")); }

std::string join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

void expectValid(const Report& report) { EXPECT_EQ(join(validate(loadSchema(), json::parse(toJson(report)))), ""); }

TEST(Schema, ReportsWithEveryVerdictAreValid) {
  expectValid(makeSampleReport());
  expectValid(makeSampleReport(hostileNames()));
  expectValid(makeSampleReportSince(hostileNames(), hostileNames()[4]));
  expectValid(makeSampleReportWithTruth(hostileNames()));
}

// The committed files are what the description makes of the report.
TEST(Schema, TheCommittedFilesAreMadeFromTheDescription) {
  const std::string folder = PARITY_SOURCE_DIR "/report/";
  const char* again = "make it again: build/describe_report .";
  EXPECT_EQ(base::readText(folder + "report.schema.json"), reportSchema()) << again;
  EXPECT_EQ(base::readText(folder + "dashboard/src/data/types.ts"), reportTypes()) << again;
}

TEST(Schema, AnEmptyReportIsValid) {
  Report empty;
  settleVerdicts(empty);
  expectValid(empty);
}

TEST(Schema, BrokenFiguresAreValidAndNull) {
  Report report = makeSampleReport();
  MaterialResult& material = report.scenes[0].views[0].materials[0];
  setFigure(material.figures, "flip.mean", NAN);
  material.figures.nonFinite = 7;
  judgeMaterial(material, compare::defaultBudgets(), "s");
  settleVerdicts(report);
  expectValid(report);
  const json document = json::parse(toJson(report));
  EXPECT_TRUE(document.at("/scenes/0/views/0/materials/0/figures/metrics/flip.mean"_json_pointer).is_null());
  EXPECT_EQ(document.at("/scenes/0/views/0/materials/0/checks/0/verdict"_json_pointer), "error");
  EXPECT_EQ(document.at("/scenes/0/views/0/materials/0/verdict"_json_pointer), "fail");
}

TEST(Schema, AnErrorWithoutAnExitCodeGetsOne) {
  Report report = makeSampleReport();
  report.scenes[1].errorExitCode = 0;
  settleVerdicts(report);
  expectValid(report);
}

// Figures by name: any may be there, but only with a number or null.
void expectNumbersOnly(const json& schema, const json& document, const json::json_pointer& where) {
  json more = document;
  more.at(where)["ssim.mean"] = nullptr;
  EXPECT_TRUE(validate(schema, more).empty()) << where.to_string();
  more.at(where)["ssim.mean"] = "0.9";
  EXPECT_FALSE(validate(schema, more).empty()) << where.to_string();
}

// Every single key of a valid report is required but those that the run was not asked for, and no other is allowed.
void expectEachKeyMatters(const json& schema, const json& document, const json::json_pointer& where) {
  const json& value = document.at(where);
  const std::string name = where.to_string();
  const bool ofTerm = name.find("/truth/terms/") != std::string::npos && value.is_object() &&
                      (where.back() == "reference" || where.back() == "test");
  const bool ofFigures = ofTerm || name.ends_with("/metrics") ||
                         (name.find("/baseline/") != std::string::npos && where.back() == "changes");
  if (ofFigures) return expectNumbersOnly(schema, document, where);
  if (value.is_object()) {
    json extra = document;
    extra.at(where)["surplus"] = 1;
    EXPECT_FALSE(validate(schema, extra).empty()) << where.to_string();
  }
  if (!value.is_structured()) return;
  for (const auto& [key, child] : value.items()) {
    if (value.is_object()) {
      json less = document;
      less.at(where).erase(key);
      const bool optional = (key == "truth" && child.contains("images")) || // not the luminance, not the image
                            key == "cost" || key == "light" ||
                            (key == "words" && name.find("/whatIf/") == std::string::npos) || key == "attribution" ||
                            key == "droppedLights" || key == "droppedLobes" || name == "/statistics" ||
                            key == "whatIf" || key == "texture" || key == "alphaCutoff" || key == "notWhole" ||
                            name + "/" + key == "/scenes/0/materials" || name + "/" + key == "/scenes/0/inputs";
      EXPECT_EQ(validate(schema, less).empty(), optional) << where.to_string() << "/" << key;
      json other = document;
      other.at(where)[key] = json::array({"wrong"});
      const bool holdsTexts = child.is_array() && (child.empty() || child[0].is_string());
      if (!holdsTexts) {
        EXPECT_FALSE(validate(schema, other).empty()) << where.to_string() << "/" << key;
      }
    }
    if (value.is_object() || key == "0")
      expectEachKeyMatters(schema, document, where / (value.is_object() ? key : "0"));
  }
}

TEST(Schema, EachKeyIsRequiredTypedAndNoOtherIsAllowed) {
  Report report = makeSampleReportSince();
  report.scenes.resize(1);
  report.scenes[0].views.resize(1);
  std::swap(report.conditions[0], report.conditions[2]); // the one in words, of which every key is tried
  std::vector<MaterialResult>& materials = report.scenes[0].views[0].materials;
  materials = {materials[1]}; // the one with terms
  report.scenes[0].error = "broken half-way";
  report.scenes[0].errorExitCode = 3;
  const ViewResult truth = makeSampleReportWithTruth().scenes[0].views[0];
  report.scenes[0].views[0].truth = truth.truth;
  materials[0].truth = truth.materials[1].truth;
  materials[0].stages = {{kEncodingStage, "rgba16f", makeFigures(0.01, 9000)}};
  report.scenes[0].views[0].stages = {{kTexturesStage, "etc2", makeFigures(0.01, 9000)}};
  report.scenes[0].views[0].droppedLights = makeDroppedLights();
  materials[0].notModelled = {"clearcoat"};
  materials[0].droppedLobes = {{"sheen", 0.25}};
  materials[0].whatIf = {makeWhatIf("refit", 0.02)};
  report.scenes[0].materials = {makeCard("metal", "rough.png")};
  settleVerdicts(report);
  const json schema = loadSchema(), document = json::parse(toJson(report));
  ASSERT_EQ(join(validate(schema, document)), "");
  expectEachKeyMatters(schema, document, json::json_pointer());
}

// What schema 2 had: two regions, and which of them a check, an attribution or a light was of.
TEST(Schema, WhatWasOfTwoRegionsIsRefused) {
  Report report = makeSampleReportSince();
  const ViewResult truth = makeSampleReportWithTruth().scenes[0].views[0];
  report.scenes[0].views[0].materials[1].truth = truth.materials[1].truth;
  report.scenes[0].views[0].droppedLights = makeDroppedLights();
  settleVerdicts(report);
  const json schema = loadSchema(), document = json::parse(toJson(report));
  ASSERT_EQ(join(validate(schema, document)), "");
  const auto expectRefused = [&](const std::string& where, const std::function<void(json&)>& spoil) {
    json old = document;
    spoil(old.at(json::json_pointer(where)));
    EXPECT_FALSE(validate(schema, old).empty()) << where;
  };
  const auto split = [](json& value) { value = {{"interior", value}, {"all", value}}; };
  const auto splitIn = [](const std::string& key) {
    return [key](json& value) {
      value["interior"] = value["all"] = value[key];
      value.erase(key);
    };
  };
  const auto addRegion = [](json& value) { value["region"] = "interior"; };
  const std::string view = "/scenes/0/views/0", metal = view + "/materials/1";
  expectRefused("", [](json& value) { value["schema"] = 2; });
  expectRefused(view + "/whole/figures", split);
  expectRefused(metal + "/figures", split);
  expectRefused(metal + "/baseline", splitIn("changes"));
  expectRefused(metal + "/truth", splitIn("figures"));
  expectRefused(metal + "/truth/terms/0", splitIn("figures"));
  expectRefused(metal + "/checks/0", addRegion);
  expectRefused(metal + "/attribution", addRegion);
  expectRefused(view + "/droppedLights/measured/0/materials/0", addRegion);
}

TEST(Schema, SharesOfClippedPixelsAndLeastSizesHaveTheirRanges) {
  const json schema = loadSchema(), document = json::parse(toJson(makeSampleReport()));
  const auto isValid = [&](const char* where, const json& value) {
    json other = document;
    other.at(json::json_pointer("/scenes/0/views/0/materials/1" + std::string(where))) = value;
    return validate(schema, other).empty();
  };
  for (const char* share : {"/figures/clippedBlack", "/figures/clippedWhite"}) {
    EXPECT_TRUE(isValid(share, 0)) << share;
    EXPECT_TRUE(isValid(share, 1)) << share;
    EXPECT_TRUE(isValid(share, nullptr)) << "not a number, as of any figure: " << share;
    EXPECT_FALSE(isValid(share, 1.01)) << share;
    EXPECT_FALSE(isValid(share, -0.01)) << share;
  }
  EXPECT_TRUE(isValid("/figures/testLuminance", 1000)) << "light before it is clipped";
  EXPECT_TRUE(isValid("/budget/minPixels", 1));
  EXPECT_FALSE(isValid("/budget/minPixels", 0));
  EXPECT_TRUE(isValid("/verdict", "too small"));
  EXPECT_TRUE(isValid("/verdict", "not judged"));
  EXPECT_FALSE(isValid("/verdict", "clipped"));
}

TEST(SchemaValidator, KnowsValidFromInvalid) {
  const auto valid = [](const char* schema, const char* document) {
    return validate(json::parse(schema), json::parse(document)).empty();
  };
  EXPECT_TRUE(valid(R"({"type":"integer","minimum":1,"maximum":3})", "3"));
  EXPECT_FALSE(valid(R"({"type":"integer","minimum":1,"maximum":3})", "4"));
  EXPECT_FALSE(valid(R"({"type":"integer","minimum":1,"maximum":3})", "0"));
  EXPECT_FALSE(valid(R"({"type":"integer"})", "1.5"));
  EXPECT_TRUE(valid(R"({"type":["number","null"]})", "null"));
  EXPECT_FALSE(valid(R"({"type":["number","null"]})", "\"1\""));
  EXPECT_FALSE(valid(R"({"required":["a"]})", "{}"));
  EXPECT_FALSE(valid(R"({"properties":{"a":{"type":"string"}}})", R"({"a":1})"));
  EXPECT_FALSE(valid(R"({"properties":{"a":{}},"additionalProperties":false})", R"({"b":1})"));
  EXPECT_FALSE(valid(R"({"items":{"enum":[1,2]}})", "[1,3]"));
  EXPECT_TRUE(valid(R"({"items":{"enum":[1,2]}})", "[1,2]"));
  EXPECT_FALSE(valid(R"({"const":1})", "2"));
  EXPECT_FALSE(valid(R"({"minItems":1})", "[]"));
  EXPECT_FALSE(valid(R"({"minLength":1})", "\"\""));
  EXPECT_TRUE(valid(R"({"anyOf":[{"type":"null"},{"const":1}]})", "1"));
  EXPECT_FALSE(valid(R"({"anyOf":[{"type":"null"},{"const":1}]})", "2"));
  EXPECT_FALSE(valid(R"({"$ref":"#/$defs/a","$defs":{"a":{"const":1}}})", "2"));
  EXPECT_TRUE(valid(R"({"$ref":"#/$defs/a","$defs":{"a":{"const":1}}})", "1"));
}

TEST(SchemaValidator, AnUnknownKeywordOrReferenceIsAFinding) {
  EXPECT_FALSE(validate(json::parse(R"({"pattern":"^a"})"), "a").empty());
  EXPECT_FALSE(validate(json::parse(R"({"$ref":"#/$defs/none"})"), "a").empty());
}

} // namespace
} // namespace parity::report
