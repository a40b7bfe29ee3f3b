// Scenes that are hard to bake, and options that make no sense: a clear error or a sane result.
#include "base/image/image_io.h"
#include "cli/bake/bake_harness.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class BakeInputTest : public BakeTest {
protected:
  std::string write(GltfFile file, const std::string& name = "scene") const {
    return writeEmbedded(m_folder, std::move(file), name);
  }
  // Sources of the lightmap: irradiance in the first three channels.
  base::Image irradianceOf(const std::string& folder) const {
    return base::readImage(std::filesystem::path(folder) / "lightmap-0.exr");
  }
  static void useCorners(GltfFile& file, const std::vector<float>& positions) {
    file.primitive()["attributes"]["POSITION"] = file.add<float>(positions, "VEC3");
  }
  static std::string manifestOf(const std::string& folder) {
    return readWholeFile(std::filesystem::path(folder) / "manifest.json");
  }
};

TEST_F(BakeInputTest, MeshesWithoutAreaAreRefusedUnlessOthersHaveOne) {
  GltfFile flat = makeLitCorner();
  useCorners(flat, {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0}); // a line: of the first mesh, which is the floor
  const RunResult result = tryBake({write(flat)}, "line");
  EXPECT_TRUE(exitedWith(0, result)) << "the wall has an area";
  EXPECT_TRUE(contains(result.err, "area")) << result.err;
  for (const int node : {0, 1}) flat.json["nodes"][node]["mesh"] = 0;
  expectRefused(tryBake({write(flat)}, "lines", {"-q"}), 4, {"nothing to bake", "area"});
  GltfFile thin = makeLitCorner();
  useCorners(thin, {0, 0, 0, 1, 0, 0, 1, 1e-20f, 0, 0, 0, 0});
  EXPECT_TRUE(exitedWith(0, tryBake({write(thin)}, "thin")));
  GltfFile squashed = makeLitCorner();
  squashed.json["nodes"][0]["scale"] = {0, 0, 0};
  EXPECT_TRUE(exitedWith(0, tryBake({write(squashed)}, "squashed")));
  GltfFile far = makeLitCorner();
  far.json["nodes"][0]["scale"] = {1e6, 1e6, 1e6};
  const RunResult refused = tryBake({write(far)}, "far", {"-q"});
  expectRefused(refused, 4, {"--texels-per-metre"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "far"));
}

TEST_F(BakeInputTest, TexelsBeyondTheMemoryAreRefusedBeforeTheyAreTaken) {
  const std::string scene = write(makeLitCorner());
  const std::vector<std::string> fine = {"bake", scene, "-q", "-o", path("out"), "--texels-per-metre", "500"};
  const RunResult refused = run(join({fine, {"--max-memory", "300M"}}));
  expectRefused(refused, 4, {"lightmap", "MiB", "--max-memory", "--texels-per-metre"});
  EXPECT_LT(refused.peakMiB, 300) << "nothing was taken yet";
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out"));
}

TEST_F(BakeInputTest, PiecesThatNoPageHoldsAreRefused) {
  GltfFile file = makeLitCorner();
  file.json["meshes"][0]["name"] = "ground"; // 2 m wide
  const std::string scene = write(std::move(file));
  expectRefused(run({"bake", scene, "-q", "-o", path("out"), "--page-size", "64", "--texels-per-metre", "100"}), 4,
                {"ground", "200 x 200 texels", "lightmap page", "--texels-per-metre"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "out"));
}

TEST_F(BakeInputTest, UvsOfTheFileAreTakenWhereTheyServe) {
  const auto noteOf = [&](const std::vector<float>& uv1, const std::string& name) {
    GltfFile file = makeLitCorner();
    if (!uv1.empty()) file.primitive()["attributes"]["TEXCOORD_1"] = file.add<float>(uv1, "VEC2");
    file.json["meshes"][0]["name"] = "ground";
    file.primitive()["attributes"].erase("TEXCOORD_0");
    const RunResult result = tryBake({write(file, name)}, name);
    EXPECT_TRUE(exitedWith(0, result));
    for (const std::string& line : linesOf(result.err))
      if (contains(line, "ground")) return line;
    return result.err;
  };
  EXPECT_TRUE(noteOf({0, 0, 1, 0, 1, 1, 0, 1}, "good").ends_with("ground: TEXCOORD_1"));
  EXPECT_TRUE(contains(noteOf({}, "none"), "unwrapped into 1 chart (no TEXCOORD_1)"));
  EXPECT_TRUE(contains(noteOf({0, 0, 1, 0, 1, 1, 1, 0}, "folded"), "unwrapped into 1 chart (TEXCOORD_1"));
  EXPECT_TRUE(contains(noteOf({0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f}, "point"), "unwrapped into 1 chart ("));
}

// Thousands of objects of one mesh: 20,000 here, a texel or two each.
TEST_F(BakeInputTest, ManyObjects) {
  GltfFile file = makeCorner();
  json &nodes = file.json["nodes"], &roots = file.json["scenes"][0]["nodes"];
  for (int i = 0; i < 20000; ++i) {
    roots.push_back(nodes.size());
    nodes.push_back(
        {{"mesh", 0}, {"translation", {i % 100, i / 100 % 100, -2 - i / 10000}}, {"scale", {0.5, 0.5, 0.5}}});
  }
  addLamp(file, {50, 50, 5});
  const std::string scene = write(std::move(file));
  const RunResult result = run({"bake", scene, "-o", path("out"), "--texels-per-metre", "1", "--error", "50%",
                                "--captures", "0", "--max-samples", "512", "--bounces", "0"});
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_LT(linesOf(result.err).size(), 30u);
  EXPECT_LT(result.peakMiB, 2048);
}

TEST_F(BakeInputTest, LightWithinAWallLightsNothing) {
  GltfFile file = makeCorner();
  // Two more quads close the wall to a box without ends, 2 cm thick; the lamp is between them.
  file.json["nodes"].push_back({{"mesh", 1}, {"translation", {-1, 0, -1.02}}, {"scale", {2, 2, 2}}});
  file.json["scenes"][0]["nodes"].push_back(2);
  addLamp(file, {0, 1, -1.01f});
  const std::string folder = bake({write(file)}, "out", {"--bounces", "0"});
  const base::Image light = irradianceOf(folder);
  double floor = 0;
  for (std::size_t i = 0; i < light.pixelCount(); ++i) {
    const float* texel = light.pixels.data() + i * static_cast<std::size_t>(light.channels);
    if (texel[8] > 0.5f) floor += texel[0]; // its normal points up
  }
  EXPECT_EQ(floor, 0);
}

TEST_F(BakeInputTest, WithASunAloneTheLightmapHoldsItsBounces) {
  const std::string scene = write(makeCorner());
  double before = -1;
  for (const std::string bounces : {"0", "1", "3"}) {
    const std::string folder = bake({scene}, "out" + bounces, join({kSun, {"--bounces", bounces}}));
    const base::Image light = irradianceOf(folder);
    double sum = 0;
    for (std::size_t i = 0; i < light.pixelCount(); ++i)
      sum += light.pixels[i * static_cast<std::size_t>(light.channels)];
    EXPECT_EQ(sum > 0, bounces != "0") << "the sun itself is not in it";
    EXPECT_GT(sum, before);
    before = sum;
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(folder) / "sun-field-0.png"));
  }
}

TEST_F(BakeInputTest, WithoutAnyLightIsRefused) {
  expectRefused(tryBake({write(makeCorner())}, "dark", {"-q"}), 4, {"no light and no environment"});
  GltfFile unlit = makeLitCorner();
  unlit.json["extensionsUsed"].push_back("KHR_materials_unlit");
  for (json& material : unlit.json["materials"]) material["extensions"]["KHR_materials_unlit"] = json::object();
  expectRefused(tryBake({write(unlit)}, "unlit", {"-q"}), 4, {"every material is unlit, so there is nothing to bake"});
  GltfFile glowing = makeCorner();
  glowing.material()["emissiveFactor"] = {1, 1, 1};
  bake({write(glowing)}, "glowing"); // emission alone is light
  EXPECT_EQ(entries().size(), 3u) << "the cache, the scene and one folder";
}

TEST_F(BakeInputTest, ScenesThatCannotBeReadDoNotStopTheOthers) {
  const std::string scene = write(makeLitCorner());
  const RunResult result = tryBake({path("none.gltf"), scene}, "all");
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_TRUE(contains(result.err, "error: " + path("none.gltf"))) << result.err;
  EXPECT_EQ(listFiles(m_folder / "all" / "scene-embedded").size(), 5u);
  expectRefused(tryBake({scene, scene}, "twice"), 64, {"two scenes have this name"});
}

TEST_F(BakeInputTest, WrongOptionsAreUsage) {
  const auto refused = [&](const std::vector<std::string>& words, const std::vector<std::string>& parts) {
    const RunResult result = run(join({{"bake"}, words}));
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_EQ(result.out, "");
    for (const std::string& part : parts) EXPECT_TRUE(contains(result.err, part)) << part << " in: " << result.err;
  };
  const std::vector<std::string> good = {"builtin:room", "-o", path("out")};
  const std::vector<std::vector<std::string>> wrong = {
      {"--error", "0"},          {"--error", "-1%"},          {"--error", "nan"},
      {"--max-samples", "1000"}, {"--max-samples", "256"},    {"--captures", "99"},
      {"--captures", "-2"},      {"--captures", "some"},      {"--capture-size", "100"},
      {"--page-size", "100"},    {"--page-size", "32"},       {"--bounces", "-1"},
      {"--bounces", "101"},      {"--texels-per-metre", "0"}, {"--texels-per-metre", "inf"},
      {"--seed", "-1"},          {"--astc", "8x8"},           {"--local-lights", "movable"}};
  for (const auto& option : wrong) refused(join({good, option}), {option[0]});
  refused({"-o", path("out")}, {"SCENE"});
  writeFile(m_folder / "suite.toml", std::string("[[scene]]\nfile = \"builtin:room\"\nbaked = \"out\"\n"));
  refused({"--suite", path("suite.toml"), "builtin:room"}, {"--suite"});
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"-o", path("out")}, {"--sun", "1,2,3"}, {"--env", "builtin:sky"}, {"--time", "1"}})
    refused(join({{"--suite", path("suite.toml")}, option}), {"--suite"});
  EXPECT_EQ(entries(), std::vector<std::string>{"suite.toml"});
}

} // namespace
} // namespace parity::tests
