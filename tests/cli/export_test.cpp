// parity export as a user meets it: a file that renders as its scene does, and refusals in words.
#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class ExportTest : public FolderTest {
protected:
  RunResult exportTo(const std::string& scene, const std::string& file,
                     const std::vector<std::string>& more = {}) const {
    return runParity(join({{"export", scene, "-o", path(file)}, more}));
  }
};

class ExportedPictureTest : public RenderingTest {};

// The same view by both paths: the file has no environment, and its camera is not the automatic one of a file.
TEST_F(ExportedPictureTest, IsThatOfTheBuiltinScene) {
  ASSERT_TRUE(exitedWith(0, runParity({"export", "builtin:materials", "-o", path("materials.glb")})));
  for (const std::string by : {"mobile", "highend"}) {
    const std::vector<std::string> light = join({{"--env", "builtin:studio", "--size", "128x128"}, kSun});
    const base::Image built = render("builtin:materials", by, light, "built.exr"),
                      exported = render(path("materials.glb"), by, join({light, {"--camera", "default"}}), "file.exr");
    ASSERT_EQ(built.pixels.size(), exported.pixels.size());
    const RunResult flip = runParity({"flip", path("built.exr"), path("file.exr"), "--metric", "flip.mean", "--fail",
                                      "0.001", "--metric", "flip", "--hardfail", "0.01"});
    EXPECT_TRUE(exitedWith(0, flip)) << by << "\n" << flip.out;
  }
}

TEST_F(ExportTest, WritesAFileThatInfoReadsWithoutAWarning) {
  const RunResult exported = exportTo("builtin:lamps", "folder/lamps.glb"); // the folder is made
  ASSERT_TRUE(exitedWith(0, exported));
  EXPECT_EQ(exported.out, "");
  EXPECT_EQ(exported.err,
            "the environment 'night' is not part of glTF, so the file lacks it; --env builtin:night gives "
            "it to the scene again\n");
  const json built = json::parse(runParity({"info", "builtin:lamps", "--json", "-"}).out),
             file = json::parse(runParity({"info", path("folder/lamps.glb"), "--json", "-"}).out);
  EXPECT_EQ(file["warnings"], json::array());
  for (const char* key : {"triangles", "vertices", "instances", "bounds", "lights", "cameras", "materials"})
    EXPECT_EQ(file[key], built[key]) << key;
}

TEST_F(ExportTest, GivesTheSameBytesAgain) {
  ASSERT_TRUE(exitedWith(0, exportTo("builtin:spheres", "a.glb")));
  ASSERT_TRUE(exitedWith(0, exportTo("builtin:spheres", "b.glb")));
  EXPECT_TRUE(readWholeFile(m_folder / "a.glb") == readWholeFile(m_folder / "b.glb"));
}

TEST_F(ExportTest, WritesWhatTheOptionsChooseOfAFile) {
  GltfFile file = makeQuad();
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
  file.json["scenes"].push_back({{"nodes", {1}}});
  file.json["materials"].push_back({{"name", "red"}});
  file.json["extensionsUsed"] = {"KHR_materials_variants"};
  file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "painted"}}};
  file.primitive()["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}};
  const int times = file.add<float>({0, 1}, "SCALAR"), places = file.add<float>({0, 0, 0, 4, 0, 0}, "VEC3");
  file.json["accessors"][times]["min"] = {0};
  file.json["accessors"][times]["max"] = {1};
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  const std::string scene = writeGlb(m_folder, file, "choices");
  const auto infoOf = [&](const std::vector<std::string>& options) {
    EXPECT_TRUE(exitedWith(0, exportTo(scene, "out.glb", options)));
    return json::parse(runParity({"info", path("out.glb"), "--json", "-"}).out);
  };
  const auto leftOf = [&](const std::vector<std::string>& options) {
    return infoOf(options)["bounds"]["lower"][0].get<double>();
  };
  EXPECT_EQ(leftOf({}), 0);
  EXPECT_EQ(leftOf({"--time", "0.5"}), 2);
  EXPECT_EQ(leftOf({"--time", "1", "--animation", "none"}), 0);
  EXPECT_EQ(leftOf({"--scene", "1"}), 5);
  EXPECT_EQ(infoOf({})["materials"][1]["flags"], json({"not shown"})) << "all materials are in the file";
  EXPECT_EQ(infoOf({"--variant", "painted"})["materials"][0]["flags"], json({"not shown"}));
}

TEST_F(ExportTest, WarnsOfWhatGltfCannotSay) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"name", "soft"}, {"range", 3}, {"extras", {{"falloffExponent", 2}}}}};
  file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.json["scenes"][0]["nodes"].push_back(1);
  const RunResult exported = exportTo(writeGlb(m_folder, file), "out.glb");
  ASSERT_TRUE(exitedWith(0, exported));
  EXPECT_TRUE(exported.err.starts_with("warning: light 'soft': glTF has no falloff exponent (2)")) << exported.err;
  EXPECT_EQ(linesOf(exported.err).size(), 1u) << exported.err;
}

TEST_F(ExportTest, RefusesInOneLine) {
  expectRefused(exportTo("builtin:material", "a.glb"), 4, {"builtin:material", "did you mean 'builtin:materials'?"});
  expectRefused(exportTo(path("none.glb"), "a.glb"), 4, {"none.glb", "does not exist"});
  expectRefused(exportTo("builtin:furnace", "a.glb", {"--scene", "2"}), 64, {"--scene", "'2'"});
  write("file", "no folder");
  expectRefused(exportTo("builtin:furnace", "file/a.glb"), 4, {path("file")});
  std::filesystem::create_directory(m_folder / "folder.glb");
  expectRefused(exportTo("builtin:furnace", "folder.glb"), 4, {path("folder.glb")});
  const std::string scene = writeGlb(m_folder, makeQuad());
  const std::string before = readWholeFile(scene);
  expectRefused(runParity({"export", scene, "-o", scene}), 64, {"-o", "would overwrite a file of the scene"});
  EXPECT_EQ(readWholeFile(scene), before);
  expectRefused(exportTo(scene, "a.glb", {"--max-memory", "1K"}), 4, {scene, "--max-memory"});
  GltfFile textured = makeQuad();
  textured.json["images"] = {{{"bufferView", textured.addBufferView(makePng(64, 32))}, {"mimeType", "image/png"}}};
  textured.json["textures"] = {{{"source", 0}}};
  textured.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  expectRefused(exportTo(writeGlb(m_folder, textured, "textured"), "a.glb", {"--max-image", "32"}), 4,
                {"textured.glb", "/images/0", "--max-image"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.glb"));
}

TEST_F(ExportTest, RefusesASceneWithoutATriangle) {
  GltfFile file = makeQuad();
  file.json["nodes"][0].erase("mesh");
  expectRefused(exportTo(writeGlb(m_folder, file), "a.glb"), 4, {"scene.glb", "the scene is empty"});
}

} // namespace
} // namespace parity::tests
