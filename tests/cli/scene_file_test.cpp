// What is loaded of a scene's file, and what is said of it: parity info, choices, limits, balls.
#include <algorithm>

#include "base/file.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

// Three materials, one of them shown; with subsurface scattering, which no path has.
GltfFile makeThree() {
  GltfFile file = makeQuad();
  file.material()["extensions"] = {{"KHR_materials_subsurface", json::object()}};
  file.json["extensionsUsed"] = {"KHR_materials_subsurface"};
  file.json["materials"].push_back({{"name", "rubber"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
  file.json["materials"].push_back({{"name", "<glow>"}, {"emissiveFactor", {1, 1, 1}}});
  return file;
}

TEST(Info, SaysWhatIsInAFile) {
  const TempFolder folder;
  const std::string path = writeGlb(folder, makeThree(), "three things");
  const RunResult text = runParity({"info", path});
  ASSERT_TRUE(exitedWith(0, text));
  EXPECT_TRUE(text.err.empty()) << text.err;
  for (const char* part : {"2 triangles", "KHR_materials_subsurface", "rubber", "nonmetal, not shown",
                           "not modelled: subsurface", "1 x 1 x 0 m"})
    EXPECT_TRUE(contains(text.out, part)) << part << " in:\n" << text.out;

  const json info = json::parse(runParity({"info", path, "--json", "-"}).out);
  EXPECT_EQ(info["triangles"], 2);
  EXPECT_EQ(info["extensionsUsed"], json({"KHR_materials_subsurface"}));
  EXPECT_EQ(info["materials"].size(), 3u);
  EXPECT_EQ(info["materials"][0]["notModelled"], json({"subsurface"}));
  EXPECT_EQ(info["materials"][1]["flags"], json({"nonmetal", "not shown"}));
  EXPECT_EQ(info["bounds"]["upper"], json({1.0, 1.0, 0.0}));
  EXPECT_EQ(info["arrays"]["nodes"], 1);
  EXPECT_EQ(info["materials"][0]["alphaMode"], "opaque");
  EXPECT_EQ(info["warnings"].size(), 1u);
  EXPECT_TRUE(exitedWith(0, runParity({"info", "builtin:spheres"})));
}

TEST(Info, ShowsCoatAndSheenWithTheirValues) {
  const TempFolder folder;
  GltfFile file = makeThree();
  file.json["images"] = {
      {{"bufferView", file.addBufferView(makePng(8, 2))}, {"mimeType", "image/png"}, {"name", "mask"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["extensions"] = {
      {"KHR_materials_clearcoat",
       {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}, {"clearcoatTexture", {{"index", 0}}}}},
      {"KHR_materials_sheen", {{"sheenColorFactor", {1, 0.5, 0}}, {"sheenRoughnessFactor", 0.75}}}};
  const std::string path = writeGlb(folder, file);
  const RunResult text = runParity({"info", path});
  ASSERT_TRUE(exitedWith(0, text));
  for (const char* part : {"coat 0.5 of roughness 0.25, sheen (1, 0.5, 0) of roughness 0.75", "coat: mask (8x2)"})
    EXPECT_TRUE(contains(text.out, part)) << part << " in:\n" << text.out;
  EXPECT_FALSE(contains(text.out, "not modelled")) << text.out;
  const json materials = json::parse(runParity({"info", path, "--json", "-"}).out)["materials"];
  EXPECT_EQ(materials[0]["coat"], 0.5);
  EXPECT_EQ(materials[0]["coatRoughness"], 0.25);
  EXPECT_EQ(materials[0]["sheenColor"], json({1.0, 0.5, 0.0}));
  EXPECT_EQ(materials[0]["sheenRoughness"], 0.75);
  EXPECT_EQ(materials[1]["coat"], 0.0);
}

TEST(Info, ShowsAnisotropyAndThinFilmsWithTheirValues) {
  const TempFolder folder;
  GltfFile file = makeThree();
  file.json["images"] = {
      {{"bufferView", file.addBufferView(makePng(8, 2))}, {"mimeType", "image/png"}, {"name", "film"}}};
  file.json["textures"] = {{{"source", 0}}};
  json film = {{"iridescenceFactor", 0.5}, {"iridescenceIor", 1.5}, {"iridescenceThicknessMaximum", 1250}};
  file.json["materials"][1]["extensions"] = {{"KHR_materials_iridescence", film}};
  film["iridescenceThicknessTexture"] = {{"index", 0}};
  file.material()["extensions"] = {
      {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.75}, {"anisotropyRotation", 1.5707963}}},
      {"KHR_materials_iridescence", film}};
  const std::string path = writeGlb(folder, file);
  const RunResult text = runParity({"info", path});
  ASSERT_TRUE(exitedWith(0, text));
  for (const char* part : {"anisotropy 0.75 turned by 90 degrees, iridescence 0.5 of index 1.5 and 100 to 1250 nm",
                           "iridescence 0.5 of index 1.5 and 1250 nm", "iridescence thickness: film (8x2)"})
    EXPECT_TRUE(contains(text.out, part)) << part << " in:\n" << text.out;
  EXPECT_FALSE(contains(text.out, "not modelled")) << text.out;
  const json materials = json::parse(runParity({"info", path, "--json", "-"}).out)["materials"];
  EXPECT_EQ(materials[0]["anisotropy"], 0.75);
  EXPECT_FLOAT_EQ(materials[0]["anisotropyRotation"].get<float>(), 1.5707963f);
  EXPECT_EQ(materials[0]["iridescence"], 0.5);
  EXPECT_EQ(materials[0]["iridescenceIor"], 1.5);
  EXPECT_EQ(materials[0]["iridescenceThickness"], json({100.0, 1250.0}));
  EXPECT_EQ(materials[2]["anisotropy"], 0.0);
  EXPECT_EQ(materials[2]["iridescence"], 0.0);
}

TEST(Info, ShowsLightThatPassesThroughWithItsValues) {
  const TempFolder folder;
  GltfFile file = makeThree();
  file.json["images"] = {
      {{"bufferView", file.addBufferView(makePng(8, 2))}, {"mimeType", "image/png"}, {"name", "depth"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}},
                                   {"KHR_materials_volume",
                                    {{"thicknessFactor", 0.25},
                                     {"thicknessTexture", {{"index", 0}}},
                                     {"attenuationDistance", 0.5},
                                     {"attenuationColor", {1, 0.5, 0.25}}}},
                                   {"KHR_materials_ior", {{"ior", 1.25}}},
                                   {"KHR_materials_dispersion", {{"dispersion", 0.375}}}};
  file.json["materials"][1]["extensions"] = {
      {"KHR_materials_diffuse_transmission",
       {{"diffuseTransmissionFactor", 0.625}, {"diffuseTransmissionColorFactor", {0.25, 1, 0.5}}}},
      {"KHR_materials_volume", {{"thicknessFactor", 2}}}};
  const std::string path = writeGlb(folder, file);
  const RunResult text = runParity({"info", path});
  ASSERT_TRUE(exitedWith(0, text));
  for (const char* part :
       {"transmission 0.75, volume of thickness 0.25 and index 1.25, (1, 0.5, 0.25) over 0.5 m, dispersion 0.375",
        "diffuse transmission 0.625 of (0.25, 1, 0.5), volume of thickness 2 and index 1.5", "thickness: depth (8x2)"})
    EXPECT_TRUE(contains(text.out, part)) << part << " in:\n" << text.out;
  EXPECT_FALSE(contains(text.out, "not modelled")) << text.out;
  const json materials = json::parse(runParity({"info", path, "--json", "-"}).out)["materials"];
  EXPECT_EQ(materials[0]["transmission"], 0.75);
  EXPECT_EQ(materials[0]["ior"], 1.25);
  EXPECT_EQ(materials[0]["thickness"], 0.25);
  EXPECT_EQ(materials[0]["attenuationDistance"], 0.5);
  EXPECT_EQ(materials[0]["attenuationColor"], json({1.0, 0.5, 0.25}));
  EXPECT_EQ(materials[0]["dispersion"], 0.375);
  EXPECT_EQ(materials[1]["diffuseTransmission"], 0.625);
  EXPECT_EQ(materials[1]["diffuseTransmissionColor"], json({0.25, 1.0, 0.5}));
  EXPECT_EQ(materials[2]["transmission"], 0.0);
  EXPECT_EQ(materials[2]["attenuationDistance"], 0.0) << "infinite";
}

TEST(Info, ListsAllProblemsOfAFile) {
  const TempFolder folder;
  GltfFile file = makeThree();
  file.primitive()["material"] = 9;
  file.json["nodes"][0]["rotation"] = {0, 0, 1};
  file.json["accessors"][0]["componentType"] = 7;
  const std::string path = writeEmbedded(folder, file);
  const RunResult result = runParity({"info", path});
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_TRUE(result.out.empty()) << result.out;
  const std::vector<std::string> lines = linesOf(result.err);
  ASSERT_EQ(lines.size(), 3u) << result.err;
  for (const std::string& line : lines) EXPECT_TRUE(line.starts_with("error: " + path + ": /")) << line;
}

class SeveralProblems : public RenderingTest {};

TEST_F(SeveralProblems, AreALineEachWhereverAReportNamesThem) {
  GltfFile file = makeThree();
  file.primitive()["material"] = 9;
  file.json["nodes"][0]["rotation"] = {0, 0, 1};
  const std::string path = writeEmbedded(m_folder, file, "bad");
  const RunResult result = runParity(join(
      {{"report", path, "-o", (m_folder / "out").string(), "--annotate", "github", "--env", "builtin:white"}, kSmall}));
  EXPECT_TRUE(exitedWith(4, result));
  const std::vector<std::string> lines = linesOf(result.out);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) { return line.starts_with("bad-embedded: error: "); }),
            2)
      << result.out;
  for (const std::string& line : linesOf(result.err)) EXPECT_TRUE(line.starts_with("error: bad-embedded: ")) << line;
  const std::string message = readReport(m_folder / "out")["scenes"][0]["error"]["message"];
  EXPECT_EQ(linesOf(message).size(), 2u) << message;
  EXPECT_FALSE(contains(message, m_folder.path().string())) << message;
  EXPECT_FALSE(contains(readWholeFile(m_folder / "out" / "junit.xml"), m_folder.path().string()));
}

TEST(Limits, OfTheCommandLineAreObeyed) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(64, 8))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  const std::string path = writeGlb(folder, file);
  EXPECT_TRUE(exitedWith(0, runParity({"info", path, "--max-image", "64", "--max-memory", "1M"})));
  expectRefused(runParity({"info", path, "--max-image", "63"}), 4, {path, "/images/0", "at most 63 a side"});
  expectRefused(runParity({"info", path, "--max-memory", "2K"}), 4, {path, "--max-memory"});
  const std::string out = (folder / "out").string();
  for (const std::vector<std::string>& command : {std::vector<std::string>{"diff", path},
                                                  {"report", path, "-o", out},
                                                  {"render", path, "--path", "mobile", "-o", out + ".png"},
                                                  {"bake", path, "-o", out + "-baked"},
                                                  {"bench", path}}) {
    const RunResult result = runParity(join({command, {"--sun", "0,45,3", "--max-image", "63"}}));
    EXPECT_TRUE(exitedWith(4, result));
    EXPECT_TRUE(contains(result.err, "at most 63 a side")) << command[0] << ": " << result.err;
  }
  for (const auto& [option, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"--max-image", "0"},
                                                                  {"--max-image", "16385"},
                                                                  {"--max-image", "1,2,3"},
                                                                  {"--max-memory", "lots"},
                                                                  {"--time", "nan"},
                                                                  {"--time", "1e10"},
                                                                  {"--variant", "red"},
                                                                  {"--scene", "7"},
                                                                  {"--animation", "run"}})
    EXPECT_TRUE(exitedWith(64, runParity({"info", path, option, value}))) << option << " " << value;
}

class SceneFileTest : public RenderingTest {};

TEST_F(SceneFileTest, BallsShowEveryMaterialAndWhatIsNotModelledIsInTheReport) {
  const std::string path = writeGlb(m_folder, makeThree());
  const auto materialsOf = [&](const std::string& name, const std::vector<std::string>& more) {
    const std::string out = (m_folder / name).string();
    const RunResult result = runParity(join(
        {{"report", path, "-o", out, "--env", "builtin:studio", "--budgets", writeBudgets(m_folder, "fail = 0.999")},
         kSmall,
         more}));
    EXPECT_TRUE(exitedWith(0, result));
    return readReport(m_folder / name)["scenes"][0]["views"][0]["materials"];
  };
  const auto notSeen = [](const json& materials) {
    return std::count_if(materials.begin(), materials.end(), [](const json& m) { return m["figures"].is_null(); });
  };
  const json scene = materialsOf("scene", {}), balls = materialsOf("balls", {"--subject", "ball"});
  ASSERT_EQ(scene.size(), 3u);
  ASSERT_EQ(balls.size(), 3u);
  EXPECT_EQ(notSeen(scene), 2);
  EXPECT_EQ(notSeen(balls), 0);
  for (const json& materials : {scene, balls}) {
    EXPECT_EQ(materials[0]["notModelled"], json({"subsurface"}));
    EXPECT_EQ(materials[0]["verdict"], "warn") << "never a plain pass";
    EXPECT_TRUE(contains(materials[0]["reason"], "base layer only: parity does not model subsurface")) << materials[0];
    for (const std::size_t plain : {1, 2}) EXPECT_EQ(materials[plain]["notModelled"], json::array());
  }
}

TEST_F(SceneFileTest, ASuiteSaysWhichVariantAndWhetherBallsAreShown) {
  GltfFile file = makeThree();
  file.json["extensions"] = {{"KHR_materials_variants", {{"variants", {{{"name", "soft"}}}}}}};
  file.primitive()["extensions"] = {{"KHR_materials_variants", {{"mappings", {{{"material", 1}, {"variants", {0}}}}}}}};
  writeGlb(m_folder, file, "things");
  writeFile(m_folder / "suite.toml", std::string("[[scene]]\nfile = \"things.glb\"\nvariant = \"soft\"\n"
                                                 "environment = \"builtin:studio\"\n"
                                                 "[[scene]]\nfile = \"things.glb\"\nname = \"balls\"\n"
                                                 "environment = \"builtin:studio\"\nsubject = \"ball\"\n"));
  const std::string suite = (m_folder / "suite.toml").string(), out = (m_folder / "out").string();
  const RunResult result = runParity(join({{"report", "--suite", suite, "-o", out}, kSmall}));
  EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
  const json report = readReport(m_folder / "out");
  const auto pixelsOf = [&](std::size_t scene, std::size_t material) {
    const json& all = report["scenes"][scene]["views"][0]["materials"][material]["figures"];
    return all.is_null() ? 0 : all["pixels"].get<int>(); // null: no view shows it
  };
  EXPECT_EQ(pixelsOf(0, 0), 0);
  EXPECT_GT(pixelsOf(0, 1), 0) << "the variant's material";
  for (std::size_t m = 0; m < 3; ++m) EXPECT_GT(pixelsOf(1, m), 0);
  EXPECT_TRUE(exitedWith(64, runParity({"report", "--suite", suite, "-o", out, "--variant", "soft"})));
}

TEST_F(SceneFileTest, ATextureOfKtx2LooksLikeThePngThatItWasMadeOf) {
  if (!std::filesystem::exists(std::filesystem::path(PARITY_BINARY_DIR) / "parity_basis.so"))
    GTEST_SKIP() << "built without npm or wabt: no transcoder of KTX 2";
  const auto pictureOf = [&](const std::string& name) {
    const bool isKtx2 = name.ends_with(".ktx2");
    GltfFile file = makeQuad();
    const auto image = base::readFile(std::filesystem::path(PARITY_SOURCE_DIR) / "tests/base/data/ktx2" / name);
    file.json["images"] = {
        {{"bufferView", file.addBufferView(image)}, {"mimeType", isKtx2 ? "image/ktx2" : "image/png"}}};
    file.json["textures"] = {isKtx2 ? json{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}
                                    : json{{"source", 0}}};
    file.material()["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}};
    const std::string picture = path(name + ".png");
    EXPECT_TRUE(exitedWith(
        0, runParity(
               join({{"render", writeGlb(m_folder, file, name), "--path", "mobile", "-o", picture}, kSmall, kSun}))));
    return picture;
  };
  const std::string source = pictureOf("basis.png");
  for (const auto& [name, limit] : {std::pair("uastc.ktx2", 0.03), {"uastc_zstd.ktx2", 0.03}, {"etc1s.ktx2", 0.2}}) {
    const RunResult result = runParity({"flip", source, pictureOf(name), "--json", "-"});
    ASSERT_TRUE(exitedWith(0, result));
    const double mean = json::parse(result.out)["pairs"][0]["pooling"]["mean"];
    EXPECT_GT(mean, 0) << name << ": it is lossy";
    EXPECT_LT(mean, limit) << name;
  }
}

} // namespace
} // namespace parity::tests
