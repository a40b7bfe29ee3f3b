// How local lights fade, and what colours the sky's reflection: the same in every path, from the command line, a suite
// and a file's extras to the pictures.
#include <cmath>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

using Json = nlohmann::json;
using shading::Term;

constexpr double kPi = 3.14159265358979;

class FalloffOfTheProgram : public RenderingTest {
protected:
  // The quad, of a grey matte dielectric, under a lamp in front of its middle.
  std::string writeLamp(Json light, double distance, const std::string& name = "lamp") {
    GltfFile file = makeQuad();
    file.material() = {{"name", "paint"},
                       {"pbrMetallicRoughness",
                        {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    light["type"] = "point";
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back(
        {{"translation", {0.5, 0.5, distance}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return writeEmbedded(m_folder, file, name);
  }
  // The quad fills the picture, whose middle pixel sees its middle.
  base::Image render(const std::string& scene, const std::string& by, const std::vector<std::string>& more) const {
    return RenderingTest::render(scene, by, join({{"--size", "33x33", "--orbit", "0,90,0.4", "--error", "4%"}, more}),
                                 by + ".exr");
  }
  // Mean FLIP of mobile's picture against high-end's, both as displayed.
  double flipBetweenPaths(const std::string& scene, const std::vector<std::string>& more) {
    const auto picture = [&](const std::string& path) { return (m_folder / (path + ".png")).string(); };
    for (const char* path : {"highend", "mobile"})
      EXPECT_TRUE(exitedWith(0, runParity(join({{"render", scene, "--path", path, "-o", picture(path)},
                                                {"--size", "64x64", "--validation"},
                                                more}))));
    const RunResult result = runParity({"flip", picture("highend"), picture("mobile"), "--json", "-"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return Json::parse(result.out)["pairs"][0]["pooling"]["mean"];
  }
};

// At the middle E = I attenuation, N.L = 1, and a matte grey sends out .5 E / pi. The same number in every path.
TEST_F(FalloffOfTheProgram, IsTheSameNumberInEveryPathByEachFormula) {
  const double d = 1.5, range = 2, q = d / range, window = 1 - std::pow(q, 4);
  const struct {
    const char* falloff;
    bool hasExponent;
    double attenuation;
  } cases[] = {{"khr", false, window / (d * d)},
               {"ue4", false, window * window / (d * d + 1e-4)},
               {"khr", true, std::pow(1 - q * q, 3)},
               {"ue4", true, std::pow(1 - q * q, 3)}}; // a light's own exponent goes first
  const int local = channelOf(Term::localDiffuse);
  for (const auto& c : cases) {
    Json light = {{"intensity", 6}, {"range", range}};
    if (c.hasExponent) light["extras"]["falloffExponent"] = 3;
    const std::string scene = writeLamp(light, d);
    for (const char* path : {"highend", "mobile", "reference"}) {
      const base::Image image =
          render(scene, path, {"--falloff", c.falloff, "--terms", "--diffuse", "lambert", "--precision", "fp32"});
      const double expected = 6 * c.attenuation * 0.5 / kPi;
      EXPECT_NEAR(image.at(16, 16)[local], expected, 1e-3 * expected) << c.falloff << ", " << path;
    }
  }
}

// With UE4's window on one path and KHR's on the other a range alone made them differ by .375.
TEST_F(FalloffOfTheProgram, AFiniteRangeIsNoDifferenceBetweenThePaths) {
  const std::vector<std::string> closeUp = {"--orbit", "0,90,0.4", "--exposure", "-1"};
  const std::string endless = writeLamp({{"intensity", 3}}, 0.6, "endless"),
                    ranged = writeLamp({{"intensity", 12}, {"range", 0.65}}, 0.6, "ranged");
  for (const std::string& scene : {endless, ranged})
    for (const char* falloff : {"khr", "ue4"}) {
      const double flip = flipBetweenPaths(scene, join({closeUp, {"--falloff", falloff}}));
      std::printf("%s %s: FLIP %.4f\n", scene == ranged ? "with range" : "without", falloff, flip);
      EXPECT_LE(flip, 0.03) << (scene == ranged ? "with range, " : "without, ") << falloff;
    }
  const base::Image khr = render(ranged, "mobile", {"--falloff", "khr"}),
                    ue4 = render(ranged, "mobile", {"--falloff", "ue4"});
  EXPECT_GT(khr.at(16, 16)[0], 2 * ue4.at(16, 16)[0]) << "the windows are far apart here";
}

TEST_F(FalloffOfTheProgram, IsNamedInTheReportAndPartOfTheCachesKey) {
  const std::string scene = writeLamp({{"intensity", 3}, {"range", 1}}, 0.6);
  const std::string cache = (m_folder / "cache").string();
  const std::string file = "file = \"" + std::filesystem::path(scene).filename().string() + "\"\n";
  writeFile(m_folder / "suite.toml",
            "[[scene]]\n" + file + "name = \"plain\"\n[[scene]]\n" + file + "name = \"ue4\"\nfalloff = \"ue4\"\n");
  const std::filesystem::path folder = m_folder / "report";
  const RunResult result = runParity({"report", "--suite", (m_folder / "suite.toml").string(), "-o", folder.string(),
                                      "-q", "--size", "32x32", "--cache", cache});
  EXPECT_LE(result.exitCode, 2) << result.err;
  const Json scenes = readReport(folder)["scenes"];
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_FALSE(scenes[0].contains("light")) << "no environment, no falloff but the default";
  EXPECT_EQ(scenes[1]["light"], "falloff of local lights: ue4");
  // The reference's cache: another light is another truth.
  const auto truth = [&](const char* falloff) {
    return runParity({"render", scene, "--path", "reference", "-o", (m_folder / "t.exr").string(), "--size", "16x16",
                      "--falloff", falloff, "--cache", cache});
  };
  EXPECT_TRUE(exitedWith(0, truth("khr")));
  const std::size_t files = listFiles(cache).size();
  EXPECT_TRUE(exitedWith(0, truth("khr")));
  EXPECT_EQ(listFiles(cache).size(), files);
  EXPECT_TRUE(exitedWith(0, truth("ue4")));
  EXPECT_GT(listFiles(cache).size(), files);
}

// A mirror shows the sky in the sky light's colour. It was two stops too bright. What is left of FLIP is what UE4's
// roughness floor of 1/64 takes, 1 - .55 / 64 = .991: a code of 8 bits; .022 of the picture whatever the colour's
// scale, 1 included.
TEST_F(FalloffOfTheProgram, AMetalObeysTheSkyLightColorInEveryPreset) {
  GltfFile file = makeQuad();
  file.material() = {{"name", "metal"}, {"pbrMetallicRoughness", {{"metallicFactor", 1}, {"roughnessFactor", 0}}}};
  const std::string scene = writeEmbedded(m_folder, file, "metal");
  for (const char* preset : {"ue4-2020", "karis2014", "refit"}) {
    const auto lit = [&](const char* color) {
      return std::vector<std::string>{"--subject",         "ball", "--env",           "builtin:white",
                                      "--sky-light-color", color,  "--mobile-preset", preset};
    };
    const double flip = flipBetweenPaths(scene, lit("0.25,0.25,0.25"));
    std::printf("%s: FLIP %.4f\n", preset, flip);
    EXPECT_LE(flip, 0.03) << preset;
    const double color[] = {0.5, 0.2, 0.1};
    for (const char* path : {"highend", "mobile"}) {
      const std::string picture = (m_folder / "mirror.exr").string();
      ASSERT_TRUE(exitedWith(0, runParity(join({{"render", scene, "--path", path, "-o", picture, "--size", "33x33"},
                                                {"--validation"},
                                                lit("0.5,0.2,0.1")}))));
      const base::Image image = base::readImage(picture);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.at(16, 16)[c] / color[c], 1, 0.012) << preset << ", " << path << ", channel " << c;
    }
  }
}

// Which scale acted is in the report: nothing of the skylight's cube, whatever is asked for else.
TEST_F(FalloffOfTheProgram, TheReportSaysWhatScalesTheReflection) {
  const auto lightOf = [](const std::vector<std::string>& more) {
    const RunResult result = runParity(join(
        {{"diff", "builtin:furnace", "--json", "-", "--attribution", "none", "--no-cache"}, kSmall, kRoughSky, more}));
    EXPECT_LE(result.exitCode, 2) << result.err;
    return Json::parse(result.out)["scenes"][0].value("light", "");
  };
  EXPECT_EQ(lightOf({}), "scale of mobile reflections: sky");
  EXPECT_EQ(lightOf({"--capture-scale", "none"}), "scale of mobile reflections: sky") << "another name";
  EXPECT_EQ(lightOf({"--mobile-preset", "karis2014"}), "scale of mobile reflections: full");
  EXPECT_EQ(lightOf({"--capture-scale", "mixing"}), "scale of mobile reflections: mixing");
}

} // namespace
} // namespace parity::tests
