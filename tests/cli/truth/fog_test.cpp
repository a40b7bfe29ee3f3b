// Fog and the scales of light, from the command line and suites to the pictures, the reports and the cache.
#include <algorithm>

#include <glm/glm.hpp>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

using shading::Term;

// Over all pixels, by channel.
glm::dvec3 sumsOf(const base::Image& image, int firstChannel) {
  glm::dvec3 sums(0.0);
  for (std::size_t p = 0; p < image.pixelCount(); ++p)
    for (int c = 0; c < 3; ++c)
      sums[c] += image.pixels[p * image.channels + static_cast<std::size_t>(firstChannel + c)];
  return sums;
}

const std::vector<std::string> kFog = {"--fog", "0.2,0.5,0", "--fog-color", "0.3,0.4,1"};
const std::vector<std::string> kPicture = {"--size", "48x32", "--terms", "--background", "0,0,0", "--error", "4%"};

class FogOfTheProgram : public RenderingTest {
protected:
  base::Image render(const std::string& by, const std::vector<std::string>& more) const {
    return RenderingTest::render("builtin:spheres", by,
                                 join({{"--cache", (m_folder / "cache").string()}, kPicture, kRoughSky, more}));
  }
  std::size_t cached() const { return listFiles(m_folder / "cache").size(); }
};

// Beyond the meshes there is none, and every path keeps the same share of its other light.
TEST_F(FogOfTheProgram, LiesOverBothPathsAndNotOverTheBackground) {
  const int fog = channelOf(Term::fog), sky = channelOf(Term::skyDiffuse);
  const struct {
    const char *path, *precision;
    float roundings; // relative: of what is kept before fog, of the product and of the fog's own share
  } runs[] = {{"highend", "fp16", 1e-4f}, {"mobile", "fp32", 1e-4f}, {"mobile", "fp16", 3 * 0x1p-11f}};
  for (const auto& [path, precision, roundings] : runs) {
    const std::vector<std::string> in = {"--precision", precision};
    const base::Image clear = render(path, in), foggy = render(path, join({in, kFog}));
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
      EXPECT_NEAR(with[sky], without[sky] * (1 - with[fog + 2]), roundings * without[sky] + 1e-6f)
          << path << " " << precision << ", " << p;
    }
    EXPECT_GT(seen, 200);
    EXPECT_LT(seen, 48 * 32);
  }
}

TEST_F(FogOfTheProgram, OfTheReferenceIsHighendsAndLiesOverWhatIsCached) {
  const std::string map = (m_folder / "error.exr").string();
  const base::Image clear = render("reference", {"--error-map", map}), clearError = base::readImage(map);
  const std::size_t files = cached();
  EXPECT_GT(files, 0u);
  const base::Image foggy = render("reference", join({kFog, {"--error-map", map}})), error = base::readImage(map);
  EXPECT_EQ(cached(), files) << "the integrals are the same";
  const base::Image highend = render("highend", kFog);
  const int fog = channelOf(Term::fog);
  int held = 0;
  for (std::size_t p = 0; p < foggy.pixelCount(); ++p) {
    const float* with = foggy.pixels.data() + p * foggy.channels;
    const float* without = clear.pixels.data() + p * clear.channels;
    EXPECT_NEAR(with[fog], highend.pixels[p * highend.channels + static_cast<std::size_t>(fog)], 1e-5f) << p;
    if (clearError.pixels[p] == 0) continue;
    const auto brightest = [](const float* c) { return std::max({c[0], c[1], c[2]}); };
    const float expected = clearError.pixels[p] * brightest(without) * (1 - with[fog + 2]) / brightest(with);
    EXPECT_NEAR(error.pixels[p], expected, 1e-3f * expected) << "the error keeps its share, too; pixel " << p;
    ++held;
  }
  EXPECT_GT(held, 100);
}

// The shaders' own part is held in tests/mobile/light_scales_test.cpp.
TEST_F(FogOfTheProgram, ScalesOfLightAreOfTheReferenceAndOfItsCachesKey) {
  const base::Image plain = render("reference", kSun);
  const std::size_t files = cached();
  const base::Image tinted = render("reference", join({kSun, {"--sky-light-color", "2,0.5,0"}}));
  EXPECT_EQ(cached(), files + 1) << "another environment";
  const base::Image matte = render("reference", join({kSun, {"--sun-specular-scale", "0.5"}}));
  EXPECT_EQ(cached(), files + 2) << "other lights";

  const int sky = channelOf(Term::skyDiffuse), specular = channelOf(Term::sunSpecular),
            diffuse = channelOf(Term::sunDiffuse);
  const glm::dvec3 before = sumsOf(plain, sky), after = sumsOf(tinted, sky);
  EXPECT_NEAR(after.x / before.x, 2, 0.02);
  EXPECT_NEAR(after.y / before.y, 0.5, 0.005);
  EXPECT_EQ(after.z, 0);
  EXPECT_EQ(sumOf(tinted, diffuse), sumOf(plain, diffuse));
  EXPECT_NEAR(sumOf(matte, specular) / sumOf(plain, specular), 0.5, 1e-5);
  EXPECT_EQ(sumOf(matte, diffuse), sumOf(plain, diffuse));
}

TEST_F(FogOfTheProgram, IsNamedInTheReportWhereItIsNotTheDefault) {
  const std::string head = "[[scene]]\nfile = \"builtin:spheres\"\nname = ";
  writeFile(m_folder / "suite.toml",
            head + "\"plain\"\n" + head + "\"foggy\"\nsky_light_color = [1, 0.5, 0]\n[scene.fog]\ndensity = 0.2\n");
  const std::filesystem::path folder = m_folder / "report";
  const RunResult result =
      runParity(join({{"report", "--suite", (m_folder / "suite.toml").string(), "-o", folder.string(), "-q"}, kSmall}));
  EXPECT_LE(result.exitCode, 2) << result.err;
  nlohmann::json scenes = readReport(folder)["scenes"];
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[0]["light"], "scale of mobile reflections: sky");
  EXPECT_EQ(scenes[1]["light"], "sky light x 1,0.5,0; fog: density 0.2 per m at 0 m, falloff 0 per m, colour "
                                "0.447,0.638,1, start 0 m, largest opacity 1; scale of mobile reflections: sky");
  EXPECT_TRUE(contains(scenes[0].at("passes").dump(), "no fog"));
  EXPECT_FALSE(contains(scenes[1].at("passes").dump(), "no fog"));
}

// A black sky is no light.
TEST_F(FogOfTheProgram, ASkyScaledToBlackIsRefusedWhereNothingElseShines) {
  const RunResult result = runParity(join({{"diff", "builtin:furnace", "--sky-light-color", "0,0,0"}, kSmall}));
  expectRefused(result, 4, {"no light and no environment"});
}

} // namespace
} // namespace parity::tests
