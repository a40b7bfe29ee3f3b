// Fog and the scales of light, from the command line and suites to the pictures, the reports and the cache.
#include <algorithm>

#include "base/image_io.h"
#include "cli/checks.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

using shading::Term;

const std::vector<std::string> kFog = {"--fog", "0.2,0.5,0", "--fog-color", "0.3,0.4,1"};
const std::vector<std::string> kPicture = {"--size", "48x32", "--terms", "--background", "0,0,0", "--error", "4%"};

class FogOfTheProgram : public RenderingTest {
protected:
  base::Image render(const std::string& path, const std::vector<std::string>& more) const {
    const std::filesystem::path file = m_folder / "out.exr";
    const RunResult result =
        runParity(join({{"render", "builtin:spheres", "--path", path, "-o", file.string(), "--validation"},
                        {"--cache", (m_folder / "cache").string()},
                        kPicture,
                        more}));
    EXPECT_TRUE(exitedWith(0, result));
    return base::readImage(file);
  }
  std::size_t cached() const { return listFiles(m_folder / "cache").size(); }
};

// Beyond the mesh there is none, the reference has high-end's per pixel, mobile's is near it on these meshes; and every
// path keeps the same share of its other light.
TEST_F(FogOfTheProgram, LiesOverEveryPathAndNotOverTheBackground) {
  const int fog = channelOf(Term::fog), sky = channelOf(Term::skyDiffuse);
  const base::Image truth = render("reference", kFog);
  for (const char* path : {"highend", "mobile", "reference"}) {
    const base::Image clear = render(path, {}), foggy = render(path, kFog);
    ASSERT_EQ(clear.pixels.size(), foggy.pixels.size());
    EXPECT_EQ(sumOf(clear, fog), 0);
    EXPECT_GT(sumOf(foggy, fog), 10);
    int seen = 0;
    for (std::size_t p = 0; p < foggy.pixelCount(); ++p) {
      const float* with = foggy.pixels.data() + p * foggy.channels;
      const float* without = clear.pixels.data() + p * clear.channels;
      if (without[0] == 0 && without[1] == 0 && without[2] == 0) {
        EXPECT_EQ(with[2], 0) << "the background";
        continue;
      }
      ++seen;
      EXPECT_NEAR(with[sky], without[sky] * (1 - with[fog + 2]), 1e-4f * without[sky] + 1e-6f)
          << path << ", pixel " << p;
      if (std::string(path) == "highend")
        EXPECT_NEAR(with[fog], truth.pixels[p * truth.channels + static_cast<std::size_t>(fog)], 1e-5f);
    }
    EXPECT_GT(seen, 200);
    EXPECT_LT(seen, 48 * 32);
  }
}

TEST_F(FogOfTheProgram, TheReferencesErrorIsLessBehindItAndItsIntegralsAreTheCached) {
  const std::string map = (m_folder / "error.exr").string();
  const base::Image clear = render("reference", {"--error-map", map}), clearError = base::readImage(map);
  const std::size_t files = cached();
  EXPECT_GT(files, 0u);
  const base::Image foggy = render("reference", join({kFog, {"--error-map", map}})), foggyError = base::readImage(map);
  EXPECT_EQ(cached(), files) << "fog is laid over what was integrated";
  const int fog = channelOf(Term::fog);
  int held = 0;
  for (std::size_t p = 0; p < foggy.pixelCount(); ++p) {
    if (clearError.pixels[p] == 0) continue;
    const float* with = foggy.pixels.data() + p * foggy.channels;
    const float* without = clear.pixels.data() + p * clear.channels;
    const auto brightest = [](const float* c) { return std::max({c[0], c[1], c[2]}); };
    const float expected = clearError.pixels[p] * brightest(without) * (1 - with[fog + 2]) / brightest(with);
    EXPECT_NEAR(foggyError.pixels[p], expected, 1e-3f * expected) << "pixel " << p;
    ++held;
  }
  EXPECT_GT(held, 100);
}

TEST_F(FogOfTheProgram, TheSkyLightsColorIsOfEveryPathAndOfTheCachesKey) {
  const std::vector<std::string> red = {"--sky-light-color", "2,0.5,0"};
  for (const char* path : {"highend", "reference", "mobile"}) {
    const base::Image plain = render(path, {});
    const std::size_t files = cached();
    const base::Image scaled = render(path, red);
    if (std::string(path) == "reference") EXPECT_EQ(cached(), files + 1) << "another environment";
    const int sky = channelOf(Term::skyDiffuse);
    EXPECT_NEAR(sumOf(scaled, sky) / sumOf(plain, sky), 2.5 / 3, 0.03) << path;
    double blue = 0;
    for (std::size_t p = 0; p < scaled.pixelCount(); ++p)
      blue += scaled.pixels[p * scaled.channels + static_cast<std::size_t>(sky) + 2];
    EXPECT_EQ(blue, 0) << path;
  }
}

TEST_F(FogOfTheProgram, SunsSpecularScaleIsOfEveryPathAndOfTheCachesKey) {
  const std::vector<std::string> half = {"--sun-specular-scale", "0.5"};
  for (const char* path : {"highend", "reference", "mobile"}) {
    const base::Image plain = render(path, kSun);
    const std::size_t files = cached();
    const base::Image scaled = render(path, join({kSun, half}));
    if (std::string(path) == "reference") EXPECT_EQ(cached(), files + 1) << "other lights";
    const int specular = channelOf(Term::sunSpecular), diffuse = channelOf(Term::sunDiffuse);
    EXPECT_NEAR(sumOf(scaled, specular) / sumOf(plain, specular), 0.5, 1e-5) << path;
    EXPECT_EQ(sumOf(scaled, diffuse), sumOf(plain, diffuse)) << path;
  }
}

TEST_F(FogOfTheProgram, IsNamedInTheReportWhereItIsNotTheDefault) {
  const std::string head = "[[scene]]\nfile = \"builtin:spheres\"\nname = ";
  writeFile(m_folder / "suite.toml",
            head + "\"plain\"\n" + head + "\"foggy\"\nsky_light_color = [1, 0.5, 0]\n[scene.fog]\ndensity = 0.2\n");
  const std::filesystem::path folder = m_folder / "report";
  const RunResult result =
      runParity(join({{"report", "--suite", (m_folder / "suite.toml").string(), "-o", folder.string(), "-q"}, kSmall}));
  EXPECT_LE(result.exitCode, 2) << result.err;
  const nlohmann::json scenes = readReport(folder)["scenes"];
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_FALSE(scenes[0].contains("light"));
  EXPECT_EQ(scenes[1]["light"], "sky light x 1,0.5,0; fog of 0.2 per m at 0 m, falloff 0 per m, colour 0.447,0.638,1, "
                                "from 0 m on, opacity to 1");
  EXPECT_TRUE(contains(scenes[0]["views"][0]["skipped"].dump(), "no fog"));
  EXPECT_FALSE(contains(scenes[1]["views"][0]["skipped"].dump(), "no fog"));
  EXPECT_TRUE(contains(readWholeFile(folder / "index.html"), "fog of 0.2 per m"));
}

// A black sky is no light.
TEST_F(FogOfTheProgram, ASkyScaledToBlackIsRefusedWhereNothingElseShines) {
  const RunResult result = runParity(join({{"diff", "builtin:furnace", "--sky-light-color", "0,0,0"}, kSmall}));
  expectRefused(result, 4, {"neither light nor environment"});
}

} // namespace
} // namespace parity::tests
