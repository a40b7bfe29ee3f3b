// --mobile-textures: what compressed textures change, what they must not, and that their cost is what it is said to be.
#include <algorithm>
#include <cstdint>
#include <random>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "cli/flip/flip_pictures.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class TexturesTest : public RenderingTest {
protected:
  // Leaves and noise: what blocks hold badly. Alpha is a half or one, in spots of four texels.
  void paintLeaves() const {
    base::Image8 image(64, 64, 4);
    std::mt19937 random(3);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        std::uint8_t* p = image.at(x, y);
        for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(40 + random() % 160);
        p[3] = (x / 4 * 7 + y / 4 * 5) % 3 == 0 ? 128 : 255;
      }
    base::writeImage8(m_folder / "leaves.png", image);
    base::Image8 bumps(64, 64, 3);
    for (std::uint8_t& value : bumps.pixels) value = static_cast<std::uint8_t>(110 + random() % 36);
    for (std::size_t i = 2; i < bumps.pixels.size(); i += 3) bumps.pixels[i] = 250;
    base::writeImage8(m_folder / "bumps.png", bumps);
  }
  // The quad with both, filling a picture that is taken from near by.
  std::string writeLeaves(const std::string& alphaMode = "OPAQUE") const {
    paintLeaves();
    GltfFile file = makeQuad();
    file.json["images"] = {{{"uri", "leaves.png"}}, {{"uri", "bumps.png"}}};
    file.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
    file.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.5}};
    file.material()["normalTexture"] = {{"index", 1}};
    file.material()["alphaMode"] = alphaMode;
    return writeExternal(m_folder, std::move(file), "leaves");
  }
  json diff(const std::string& scene, const std::string& block, const std::vector<std::string>& more = {}) const {
    const RunResult result =
        runParity(join({{"diff", scene, "--mobile-textures", block, "--json", "-"}, kSmall, kSun, more}));
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
    return json::parse(result.out).at("scenes").at(0);
  }
  std::string render(const std::string& scene, const std::string& path, const std::string& block,
                     const std::string& file, const std::vector<std::string>& more = {}) const {
    const std::string output = (m_folder / file).string();
    EXPECT_TRUE(
        exitedWith(0, runParity(join({{"render", scene, "--path", path, "--mobile-textures", block, "-o", output},
                                      kSmall,
                                      kSun,
                                      kNear,
                                      more}))));
    return output;
  }
  const std::vector<std::string> kNear = {"--orbit", "0,90,0.6"};
};

json stageOf(const json& scene) { return scene.at("views").at(0).at("whole").at("stages").at(1); }
double meanOf(const json& stage) { return stage.at("figures").at("metrics").at("flip.mean"); }
const json& passOf(const json& scene, const std::string& name) {
  for (const json& pass : scene.at("passes"))
    if (pass.at("name") == name) return pass;
  throw std::out_of_range(name);
}

TEST_F(TexturesTest, TheirCostIsTheFlipOfTwoPicturesOfMobile) {
  const std::string scene = writeLeaves();
  double before = 0;
  for (const std::string block : {"astc4x4", "astc6x6"}) {
    const json result = diff(scene, block, kNear), stage = stageOf(result);
    EXPECT_EQ(stage.at("through"), block);
    EXPECT_GT(meanOf(stage), before) << "larger blocks lose more";
    before = meanOf(stage);
    ASSERT_EQ(stage.at("figures").at("pixels"), 64 * 64) << "the picture must be full of it";
    const RunResult flip = runParity({"flip", render(scene, "mobile", "none", "originals.png"),
                                      render(scene, "mobile", block, block + ".png"), "--json", "-"});
    const double expected = firstFigures(json::parse(flip.out)).at("flip.mean");
    EXPECT_NEAR(meanOf(stage), expected, 1e-5) << block;
    EXPECT_EQ(result.at("views").at(0).at("materials").at(0).at("stages").at(1), stage) << "one material is all";
    EXPECT_EQ(passOf(result, "texture compression").at("count"), 2);
  }
  EXPECT_GT(before, 0.01);
}

// The other codec, whose blocks lose more than ASTC's of the same size.
TEST_F(TexturesTest, GoThroughEtc2Too) {
  const std::string scene = writeLeaves();
  const json result = diff(scene, "etc2", kNear), stage = stageOf(result);
  EXPECT_EQ(stage.at("through"), "etc2");
  EXPECT_GT(meanOf(stage), meanOf(stageOf(diff(scene, "astc4x4", kNear))));
  EXPECT_EQ(passOf(result, "texture compression").at("count"), 2);
}

TEST_F(TexturesTest, OfASceneWithoutAnyCostNothing) {
  const json result = diff(writeEmbedded(m_folder, makeQuad()), "astc6x6", {"--attribution", "none"});
  EXPECT_EQ(stageOf(result).at("figures").at("metrics").at("flip.max"), 0);
  EXPECT_EQ(passOf(result, "texture compression").at("skipped"), "no visible material has one");
  EXPECT_EQ(passOf(result, "shade mobile").at("count"), passOf(result, "surface").at("count")) << "shaded once";
}

TEST_F(TexturesTest, AreNoPartOfAReportThatDidNotAsk) {
  const json result = diff(writeLeaves(), "none");
  EXPECT_EQ(result.at("views").at(0).at("whole").at("stages").size(), 1u) << "the target";
  EXPECT_EQ(result.at("views").at(0).at("materials").at(0).at("stages").size(), 1u);
  EXPECT_EQ(passOf(result, "texture compression").at("skipped"), "not requested");
}

TEST_F(TexturesTest, StandInTheTableAndTheSettings) {
  const RunResult result = runParity(join({{"diff", writeLeaves(), "--mobile-textures", "astc6x6"}, kSmall, kSun}));
  EXPECT_TRUE(contains(result.out, " textures ")) << result.out;
  EXPECT_TRUE(contains(result.out, "the textures of mobile as astc6x6")) << result.out;
  const RunResult report = runParity(join(
      {{"report", writeLeaves(), "--mobile-textures", "astc6x6", "-o", (m_folder / "out").string()}, kSmall, kSun}));
  EXPECT_EQ(report.signal, 0) << report.err;
  const json settings = readReport(m_folder / "out").at("settings");
  const json expected = {{"name", "mobile textures"}, {"value", "astc6x6, 3.56 bits a texel"}};
  EXPECT_EQ(std::count(settings.begin(), settings.end(), expected), 1) << settings;
}

TEST_F(TexturesTest, AreTheMobilePathsAlone) {
  const std::string scene = writeLeaves();
  for (const std::string path : {"highend", "mobile"}) {
    const bool same = readWholeFile(render(scene, path, "none", "before.exr")) ==
                      readWholeFile(render(scene, path, "astc6x6", "after.exr"));
    EXPECT_EQ(same, path == "highend") << path;
  }
}

// Alpha is compressed, too, but what is seen is decided by the textures as they are, and so is a blended material's
// share of a pixel.
TEST_F(TexturesTest, DecideNeitherWhatIsSeenNorHowMuchOfIt) {
  for (const std::string mode : {"MASK", "BLEND"}) {
    const std::string scene = writeLeaves(mode);
    const json plain = diff(scene, "none", kNear), compressed = diff(scene, "astc6x6", kNear);
    const auto figuresOf = [](const json& result, const char* path) {
      return result.at("views").at(0).at("materials").at(0).at("figures").at(path);
    };
    EXPECT_EQ(figuresOf(plain, "pixels"), figuresOf(compressed, "pixels")) << mode;
    EXPECT_EQ(figuresOf(plain, "referenceLuma"), figuresOf(compressed, "referenceLuma"))
        << mode << ": weighed by the same mask";
    EXPECT_NE(figuresOf(plain, "testLuma"), figuresOf(compressed, "testLuma")) << mode;
  }
}

TEST_F(TexturesTest, AreTheSameFromTheCacheAndOnOneThread) {
  const std::string scene = writeLeaves(), cache = (m_folder / "cache").string();
  const std::vector<std::string> with = {"--cache", cache};
  const auto bytes = [&](const std::vector<std::string>& more) {
    return readWholeFile(render(scene, "mobile", "astc6x6", "picture.exr", more));
  };
  const std::string first = bytes(with);
  const json kinds = json::parse(runParity({"cache", "info", "--cache", cache, "--json", "-"}).out).at("kinds");
  EXPECT_TRUE(std::any_of(kinds.begin(), kinds.end(), [](const json& kind) {
    return kind.at("kind") == "blocks" && kind.at("entries") == 2; // of both images the base level alone is worth it
  })) << kinds;
  EXPECT_EQ(bytes(with), first);
  EXPECT_EQ(bytes({"--no-cache", "--threads", "1"}), first);
  EXPECT_NE(readWholeFile(render(scene, "mobile", "astc4x4", "picture.exr", with)), first) << "another key";
}

} // namespace
} // namespace parity::tests
