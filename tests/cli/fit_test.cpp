// parity fit: constants on stdout or in a file, alone there; what the shader holds by default.

#include "cli/checks.h"

namespace parity::tests {
namespace {

TEST(Fit, JsonOnStdoutMeetsTheTargetsWithTheDefaults) {
  const RunResult result = runParity({"fit", "--format", "json"});
  ASSERT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(contains(result.err, "fitting the specular lobe")) << result.err;
  const nlohmann::json json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["settings"]["compensation"], "kulla-conty");
  EXPECT_EQ(json["settings"]["geometryTerm"], "height-correlated");
  EXPECT_EQ(json["constants"]["B"].size(), 7u);
  EXPECT_NEAR(json["constants"]["lean"][0].get<double>(), 1.48446, 2e-3); // shading/refit.glsl
  const nlohmann::json& albedo = json["errors"]["albedo"];
  EXPECT_EQ(albedo[0]["F0"], "0.04");
  EXPECT_LE(albedo[0]["rms"].get<double>(), 0.01);
  EXPECT_LE(albedo[2]["rms"].get<double>(), 0.02);
  EXPECT_LE(json["errors"]["direct"]["rmsLogRatio"].get<double>(), 0.2);
  EXPECT_LE(json["errors"]["direct"]["exitanceMax"].get<double>(), 1.05);
}

TEST(Fit, WritesHlslForOtherSettings) {
  const TempFolder folder;
  const std::filesystem::path file = folder / "refit.hlsl";
  const RunResult result = runParity({"fit", "--geometry-term", "schlick-smith", "--compensation", "none", "--fresnel",
                                      "dielectric", "--format", "hlsl", "-o", file.string(), "-q", "--threads", "1"});
  ASSERT_TRUE(exitedWith(0, result));
  EXPECT_EQ(result.out + result.err, "");
  const std::string text = readWholeFile(file);
  EXPECT_TRUE(contains(text, "geometry term schlick-smith, Fresnel dielectric, compensation none")) << text;
  EXPECT_TRUE(contains(text, "static const float kRefitB[7] = {")) << text;
  EXPECT_FALSE(contains(text, "kRefitReturn")) << text;
}

} // namespace
} // namespace parity::tests
