// --paths: which path is compared with which.
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class PathsTest : public RenderingTest {
protected:
  json diff(const std::vector<std::string>& more) {
    const std::string file = path("diff.json");
    const RunResult result = runParity(join({{"diff", "builtin:spheres", "--json", file}, kSmall, kSun, more}));
    EXPECT_EQ(result.signal, 0) << result.err;
    return json::parse(readWholeFile(file)).at("scenes").at(0).at("views").at(0);
  }
};

// The same two pictures the other way round: FLIP is nearly symmetric, light that one has more the other has less.
TEST_F(PathsTest, TheOthersAreComparedWithTheFirst) {
  const json usual = diff({}), turned = diff({"--paths", "mobile,highend"});
  EXPECT_EQ(usual["reference"], "highend");
  EXPECT_EQ(usual["test"], "mobile");
  EXPECT_EQ(turned["reference"], "mobile");
  EXPECT_EQ(turned["test"], "highend");
  const json &a = usual["whole"]["figures"], &b = turned["whole"]["figures"];
  EXPECT_EQ(a["referenceLuma"], b["testLuma"]);
  EXPECT_EQ(a["testLuma"], b["referenceLuma"]);
  EXPECT_NEAR(a["metrics"]["bias.dl"].get<double>(), -b["metrics"]["bias.dl"].get<double>(), 1e-9);
  EXPECT_GT(a["metrics"]["flip.mean"], 0);
}

// Textures and target of the first are its own, and no stage of the row.
TEST_F(PathsTest, TheFirstMayCompressAndStore) {
  const json view = diff({"--paths", "mobile,highend", "--mobile-textures", "astc6x6", "--attribution", "all"});
  EXPECT_TRUE(view["whole"]["stages"].empty());
  EXPECT_TRUE(view["materials"][0].contains("attribution"));
}

TEST_F(PathsTest, PicturesAreNamedByPath) {
  const std::filesystem::path folder = m_folder / "report";
  const RunResult result = runParity(
      join({{"report", "builtin:spheres", "--paths", "mobile,highend", "-o", folder.string()}, kSmall, kSun}));
  EXPECT_EQ(result.signal, 0) << result.err;
  const json images =
      json::parse(readWholeFile(folder / "report.json")).at("scenes").at(0).at("views").at(0).at("images");
  EXPECT_TRUE(contains(images["reference"].get<std::string>(), "_mobile.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / images["test"].get<std::string>()));
}

// Its errors are against the first of all paths.
TEST_F(PathsTest, BenchRefusesAnotherFirstOne) {
  const RunResult result = runParity({"bench", "--list", "--paths", "mobile,highend"});
  EXPECT_TRUE(exitedWith(64, result));
  EXPECT_TRUE(contains(result.err, "--paths")) << result.err;
}

TEST_F(PathsTest, BenchReadsBakedLight) {
  const RunResult result = runParity({"bench", "builtin:spheres", "--baked", path("nowhere")});
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_TRUE(contains(result.err, "nowhere")) << result.err;
}

TEST_F(PathsTest, OneAloneOrAnUnknownOneIsRefused) {
  for (const char* paths : {"mobile", "highend,desktop", "highend,highend"}) {
    const RunResult result = runParity({"diff", "builtin:spheres", "--paths", paths});
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_TRUE(contains(result.err, "--paths: '" + std::string(paths) + "'")) << result.err;
  }
}

} // namespace
} // namespace parity::tests
