// Fits as text: what is printed is what was fitted.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "study/fit/refit_text.h"

namespace parity::tests {
namespace {

using namespace fit;

Refit sample() {
  Refit refit{};
  refit.settings.geometryTerm = GeometryTerm::schlickSmith;
  refit.lobe = {{-1.5, 2, 3, 4, 5, 6, -7.25}, {0.5, 0.25, 1e-7}, 0.75};
  refit.spread = 0.625;
  refit.tap = {{1, -2}, {5.5, 1.25, 3}, {1.5, -0.25, 0.75}};
  refit.albedo = {{"0.04", 0.0051, 0.0422}};
  refit.direct = {0.02, 0.9, 1.1, 1.03};
  refit.sheen = {{-2, 0.5, 1, 2, 3, 4, 5, 6, 7, 8.5}, 0.0063, 0.0425};
  return refit;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(RefitText, GivesEachLanguageItsArrays) {
  const std::string glsl = formatShader(sample(), Language::glsl), hlsl = formatShader(sample(), Language::hlsl);
  EXPECT_TRUE(has(glsl, "const float kRefitB[7] = float[7](-1.5, 2.0, 3.0, 4.0, 5.0, 6.0, -7.25);\n")) << glsl;
  EXPECT_TRUE(has(glsl, "const float kRefitLoss[3] = float[3](0.5, 0.25, 1e-07);\n")) << glsl;
  EXPECT_TRUE(has(hlsl, "static const float kRefitB[7] = {-1.5, 2.0, 3.0, 4.0, 5.0, 6.0, -7.25};\n")) << hlsl;
  EXPECT_TRUE(has(hlsl, "static const float kRefitReturn = 0.75;\n")) << hlsl;
  EXPECT_TRUE(has(glsl, "kRefitSheen[10] = float[10](-2.0, 0.5, 1.0,")) << glsl;
  for (const std::string& text : {glsl, hlsl})
    for (const char* part :
         {"schlick-smith", "kulla-conty", "F0 0.04", "rms 0.0051", "max 0.0422", "kRefitSpread", "rms 0.0063"})
      EXPECT_TRUE(has(text, part)) << part;
}

TEST(RefitText, LeavesOutWhatTheSettingsDoNotHave) {
  Refit none = sample();
  none.settings.compensation = Compensation::none;
  none.spread = 0;
  const std::string text = formatShader(none, Language::glsl);
  EXPECT_FALSE(has(text, "kRefitReturn"));
  EXPECT_FALSE(has(text, "kRefitSpread"));
  EXPECT_TRUE(has(text, "M = 0"));
}

TEST(RefitText, JsonHoldsTheSameNumbers) {
  const nlohmann::json json = nlohmann::json::parse(formatJson(sample()));
  EXPECT_EQ(json["constants"]["B"][6], -7.25);
  EXPECT_EQ(json["constants"]["loss"][2], 1e-7);
  EXPECT_EQ(json["constants"]["wide"][1], -0.25);
  EXPECT_EQ(json["settings"]["geometryTerm"], "schlick-smith");
  EXPECT_EQ(json["errors"]["albedo"][0]["max"], 0.0422);
  EXPECT_EQ(json["errors"]["direct"]["exitanceMax"], 1.03);
  EXPECT_EQ(json["constants"]["sheen"][9], 8.5);
  EXPECT_EQ(json["errors"]["sheen"]["max"], 0.0425);
}

TEST(RoundConstant, KeepsSixDigits) {
  EXPECT_EQ(roundConstant(1.23456789), 1.23457);
  EXPECT_EQ(roundConstant(-0.0001234567), -0.000123457);
  EXPECT_EQ(roundConstant(5), 5);
}

} // namespace
} // namespace parity::tests
