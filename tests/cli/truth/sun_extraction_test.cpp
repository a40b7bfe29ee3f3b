// The sun of an environment becomes a light: in every path, in the report, and not where it is not wanted.

#include "base/image/image.h"
#include "base/image/image_io.h"
#include "cli/checks.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

const std::vector<std::string> kSky = {"--env", "builtin:sky"};
const std::vector<std::string> kLeft = {"--no-sun-extraction"};

class SunExtractionTest : public RenderingTest {
protected:
  base::Image render(const std::string& by, const std::vector<std::string>& more) const {
    return RenderingTest::render(
        "builtin:spheres", by, join({{"--terms", "--background", "0,0,0", "--error", "10%", "--size", "48x32"}, more}));
  }
  nlohmann::json report(const std::vector<std::string>& more) const {
    const RunResult result =
        runParity(join({{"report", "-o", (m_folder / "report").string(), "--size", "16x16"}, more}));
    EXPECT_TRUE(isReported(result)) << result.err;
    return readReport(m_folder / "report");
  }
};

// Half of the sky's light on these spheres is the sun's. What is moved from the one term to the other is not lost; the
// split sum apart, which the rough spheres' highlights do without (docs/shading.md 6b).
TEST_F(SunExtractionTest, MovesLightFromTheSkysTermsToTheSunsInEveryPath) {
  for (const char* path : {"highend", "mobile", "reference"}) {
    const base::Image with = render(path, kSky), left = render(path, join({kSky, kLeft}));
    const int sun = channelOf(shading::Term::sunDiffuse), sky = channelOf(shading::Term::skyDiffuse);
    EXPECT_EQ(sumOf(left, sun), 0) << path;
    EXPECT_GT(sumOf(with, sun), 0.3 * sumOf(left, sky)) << path;
    EXPECT_GT(sumOf(with, channelOf(shading::Term::sunSpecular)), 0) << path;
    EXPECT_NEAR((sumOf(with, sun) + sumOf(with, sky)) / sumOf(left, sky), 1, 0.05) << path;
  }
}

// Two lamps on a grey ground, in cells of 1.4 degrees.
std::string writeTwoSuns(const std::filesystem::path& file) {
  base::Image image(256, 128, 3, 0.3f);
  for (const auto& [x, radiance] : {std::pair(100, 3000.f), std::pair(180, 2000.f)})
    for (int c = 0; c < 3; ++c) image.at(x, 40)[c] = radiance;
  base::writeImage(file, image);
  return file.string();
}

TEST_F(SunExtractionTest, IsNamedInTheReportSceneByScene) {
  writeTwoSuns(m_folder / "two.hdr");
  const std::string head = "[[scene]]\nfile = \"builtin:spheres\"\nenvironment = ", sky = "\"builtin:sky\"\nname = ";
  writeFile(m_folder / "suite.toml", head + sky + "\"a\"\n" + head + sky + "\"b\"\nsun_extraction = false\n" + head +
                                         sky + "\"c\"\nsun = [30, 50, 4]\n" + head + "\"two.hdr\"\nname = \"d\"\n");
  const nlohmann::json scenes = report({"--suite", (m_folder / "suite.toml").string()})["scenes"];
  const std::string text = "extracted from sky: azimuth 120.00, elevation 42.00, 2.227 lux";
  EXPECT_EQ(scenes[0]["sun"], text);
  EXPECT_EQ(scenes[1]["sun"], "none");
  EXPECT_EQ(scenes[2]["sun"], "30,50,4; " + text);
  EXPECT_TRUE(contains(scenes[3]["sun"], "extracted from two: azimuth -38.67")) << scenes[3]["sun"];
  EXPECT_TRUE(contains(scenes[3]["sun"], "and 1 fainter"));
  for (const nlohmann::json& scene : scenes)
    EXPECT_EQ(scene["warnings"].dump().find("left out"), std::string::npos) << "mobile loses no light: " << scene;
}

// Mobile has one sun. Beside a brighter one of the user's, and for the fainter of two, its map keeps what highend has
// as lights: the same irradiance arrives.
TEST_F(SunExtractionTest, MobileKeepsInItsMapWhatIsNotItsOneSun) {
  const int sun = channelOf(shading::Term::sunDiffuse), sky = channelOf(shading::Term::skyDiffuse);
  const base::Image bare = render("mobile", join({kSky, kLeft})), beside = render("mobile", join({kSky, kSun}));
  EXPECT_EQ(sumOf(beside, sky), sumOf(bare, sky)) << "the whole map, although --sun 4 lux goes before its 2.2";
  const base::Image highend = render("highend", join({kSky, kSun}));
  EXPECT_LT(sumOf(highend, sky), 0.8 * sumOf(bare, sky));
  EXPECT_GT(sumOf(highend, sun), sumOf(beside, sun));

  const std::vector<std::string> two = {"--env", writeTwoSuns(m_folder / "two.hdr")};
  const base::Image mobile = render("mobile", two), both = render("highend", two);
  EXPECT_GT(sumOf(both, sun), 1.2 * sumOf(mobile, sun));
  EXPECT_GT(sumOf(mobile, sky), 1.2 * sumOf(both, sky));
}

} // namespace
} // namespace parity::tests
