// Small files that ask for much: refused before memory is taken.
#include "scenes/gltf_json.h"
#include "scenes/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

TEST(GltfLimits, RefusesMeshesThatGrowBeyondTheMemoryAllowed) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  // 300,000 corners of one byte each, and no normals: every corner becomes a vertex of its own.
  file.primitive()["indices"] = file.add<std::uint8_t>(std::vector<std::uint8_t>(300000, 1), "SCALAR");
  file.primitive()["attributes"].erase("NORMAL");
  const nlohmann::json primitive = file.primitive();
  for (int i = 0; i < 100; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
  const std::string path = writeGlb(folder, file);
  expectError([&] { scenes::loadScene(path, {.maxMemoryBytes = std::size_t{1} << 30}); },
              {path, "/meshes/0/primitives/", "the limit of a scene is 1024 MiB (--max-memory)"});
}

// 2.4 MB of corners; the lists by which tangents are made take 56 bytes of each, and each becomes a vertex.
TEST(GltfLimits, RefusesTangentsThatTakeMoreThanTheMemoryAllowed) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  std::vector<std::uint8_t> corners;
  for (int i = 0; i < 100000; ++i) corners.insert(corners.end(), {0, 1, 2, 0, 2, 3});
  file.primitive()["indices"] = file.add<std::uint8_t>(corners, "SCALAR");
  const auto load = [&] { return scenes::loadScene(writeGlb(folder, file), {.maxMemoryBytes = std::size_t{16} << 20}); };
  EXPECT_EQ(load().meshes[0].indices.size(), corners.size());
  writeFile(folder / "bumps.png", makePng(2, 2));
  file.json["images"] = {{{"uri", "bumps.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  expectError(load, {"/meshes/0/primitives/0: needs", "(--max-memory)"});
}

TEST(GltfLimits, RefusesAMillionInstances) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  const nlohmann::json primitive = file.primitive();
  for (int i = 1; i < 1024; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
  file.json["scenes"][0]["nodes"] = nlohmann::json::array();
  file.json["nodes"] = nlohmann::json::array();
  for (int i = 0; i < 1025; ++i) {
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["scenes"][0]["nodes"].push_back(i);
  }
  const std::string path = writeGlb(folder, file);
  expectError([&] { scenes::loadScene(path); }, {path, "/nodes: place more than 1048576 primitives"});
}

TEST(GltfLimits, RefusesJsonOfTooManyValues) {
  std::string text = "[0";
  for (std::size_t i = 0; i <= scenes::kMaxJsonValues; ++i) text += ",0";
  expectError([&] { scenes::parseGltfJson(text + "]", "a.gltf"); }, {"a.gltf: JSON: more than 8388608 values"});
  const std::string nested(scenes::kMaxJsonDepth + 1, '[');
  expectError([&] { scenes::parseGltfJson(nested, "a.gltf"); }, {"nested deeper than 64 levels"});
  EXPECT_EQ(scenes::parseGltfJson("[\"[[{,:\\\"[\"]", "a.gltf").size(), 1u) << "strings are no structure";
}

TEST(GltfLimits, CutsALongListOfWarnings) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  for (int i = 0; i < 150; ++i) file.json["materials"].push_back({{"pbrMetallicRoughness", {{"roughnessFactor", 2}}}});
  const scenes::Scene scene = scenes::loadScene(writeGlb(folder, file));
  ASSERT_EQ(scene.warnings.size(), 101u);
  EXPECT_EQ(scene.warnings.back(), "50 more warnings");
}

} // namespace
} // namespace parity::tests
