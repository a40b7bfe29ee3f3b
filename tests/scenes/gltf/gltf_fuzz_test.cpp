// Damaged containers: whatever bytes come, the loader answers with a scene or with one Error. Nothing else.
#include <random>

#include "scenes/gltf/draco_writer.h"
#include "scenes/gltf/file/container.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

// A small scene that touches most of the loader: texture, light, camera, material, hierarchy.
GltfFile makeRichFile() {
  GltfFile file = makeQuad();
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(3, 3))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  file.json["samplers"] = {{{"wrapS", 10497}, {"minFilter", 9987}}};
  file.material()["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  file.json["nodes"][0]["children"] = {1};
  file.json["nodes"].push_back(
      {{"camera", 0}, {"translation", {0, 1, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  return file;
}

// The quad with all that bends, moves, multiplies and packs it.
GltfFile makePosedFile() {
  GltfFile file = makeQuad();
  const std::vector<float> numbers(16, 0.25f);
  auto& attributes = file.primitive()["attributes"];
  attributes["JOINTS_0"] = file.add<std::uint8_t>(std::vector<std::uint8_t>(16, 1), "VEC4");
  attributes["WEIGHTS_0"] = file.add<float>(numbers, "VEC4");
  const int moved = file.add<float>(std::vector<float>(12, 0.5f), "VEC3");
  file.primitive()["targets"] = {{{"POSITION", moved}, {"NORMAL", moved}}};
  file.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", file.addBufferView({std::byte{2}})}, {"componentType", 5121}}},
      {"values", {{"bufferView", file.addBufferView(std::vector<std::byte>(12))}}}};
  file.json["skins"] = {
      {{"joints", {1, 2}}, {"inverseBindMatrices", file.add<float>(std::vector<float>(32, 0.f), "MAT4")}}};
  for (const std::size_t i : {0u, 5u, 10u, 15u, 16u, 21u, 26u, 31u}) { // two unit matrices
    const float one = 1;
    std::memcpy(&file.bin[file.bin.size() - 128 + 4 * i], &one, 4);
  }
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"weights", {0.5}}, {"children", {1, 3}}},
                        {{"children", {2}}},
                        {{"translation", {0, 1, 0}}},
                        {{"mesh", 1}}};
  file.json["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", moved}};
  const int times = file.add<float>({0, 1}, "SCALAR"), turns = file.add<float>({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
  file.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "rotation"}}}}}},
                              {"samplers", {{{"input", times}, {"output", turns}}}}}};
  const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  const int stream = file.addBufferView(encodeDraco({corners, {}, {}, {}, {0, 1, 2}}, true));
  file.json["accessors"].push_back({{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  file.json["accessors"].push_back({{"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}});
  const std::size_t last = file.json["accessors"].size() - 1;
  file.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", last - 1}}}, {"indices", last}}}}});
  file.json["meshes"][1]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", stream}, {"attributes", {{"POSITION", 0}}}};
  return file;
}

// True: an error; false: a scene, whose indices are then checked.
bool isRefused(const std::string& file) {
  try {
    const scenes::Scene scene = scenes::loadScene(file);
    for (const scenes::Mesh& mesh : scene.meshes) {
      for (const std::uint32_t index : mesh.indices) EXPECT_LT(index, mesh.positions.size());
      EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
      EXPECT_LT(mesh.material, scene.materials.size());
    }
    return false;
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::failed) << error.what();
    EXPECT_EQ(std::string(error.what()).find(file), 0u) << error.what();
    return true;
  }
}

TEST(GltfFuzz, RefusesABinaryFileCutAtAnyLength) {
  const TempFolder folder;
  const std::vector<std::byte> glb = makeGlb(makeRichFile());
  const std::string path = (folder / "cut.glb").string();
  for (std::size_t length = 0; length < glb.size(); ++length) {
    writeFile(path, std::vector<std::byte>(glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(length)));
    EXPECT_TRUE(isRefused(path)) << "cut to " << length << " of " << glb.size();
  }
  writeFile(path, glb);
  EXPECT_FALSE(isRefused(path)) << "whole";
}

TEST(GltfFuzz, RefusesATextFileCutAtAnyLength) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  const std::string whole = writeEmbedded(folder, file);
  std::string text;
  {
    file.json["buffers"] = {{{"uri", "data:;base64," + encodeBase64(file.bin)}, {"byteLength", file.bin.size()}}};
    text = file.json.dump();
  }
  for (std::size_t length = 0; length < text.size(); length += 7) {
    writeFile(folder / "cut.gltf", text.substr(0, length));
    EXPECT_TRUE(isRefused((folder / "cut.gltf").string())) << "cut to " << length;
  }
  EXPECT_FALSE(isRefused(whole));
}

void flipBytes(const GltfFile& file) {
  const TempFolder folder;
  const std::vector<std::byte> glb = makeGlb(file);
  const std::string path = (folder / "flipped.glb").string();
  std::mt19937 random(20140817); // fixed: a failure can be run again
  int refused = 0;
  constexpr int kRounds = 1000;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::byte> damaged = glb;
    for (std::uint32_t flips = 1 + random() % 4; flips > 0; --flips)
      damaged[random() % damaged.size()] ^= static_cast<std::byte>(1 + random() % 255);
    writeFile(path, damaged);
    refused += isRefused(path);
  }
  EXPECT_GT(refused, kRounds / 4) << "most damage to JSON must be noticed";
}

TEST(GltfFuzz, SurvivesFlippedBytesEverywhere) {
  flipBytes(makeRichFile());
  flipBytes(makePosedFile());
}

void replaceNumbers(const GltfFile& file) {
  const TempFolder folder;
  std::string text = [&] {
    GltfFile embedded = file;
    embedded.json["buffers"] = {{{"uri", "rich.bin"}, {"byteLength", file.bin.size()}}};
    return embedded.json.dump();
  }();
  writeFile(folder / "rich.bin", file.bin);
  const std::string values[] = {"-1", "1", "4294967295", "1e308", "null", "\"x\"", "[]", "{}", "2147483647", "0.5"};
  int tried = 0;
  for (std::size_t at = 1; at < text.size(); ++at) {
    if (!isdigit(static_cast<unsigned char>(text[at])) ||
        (text[at - 1] != ':' && text[at - 1] != '[' && text[at - 1] != ','))
      continue;
    std::size_t end = at;
    while (isdigit(static_cast<unsigned char>(text[end])) || text[end] == '.') ++end;
    for (const std::string& value : values) {
      writeFile(folder / "rich.gltf", text.substr(0, at) + value + text.substr(end));
      isRefused((folder / "rich.gltf").string());
      ++tried;
    }
  }
  EXPECT_GT(tried, 300);
}

TEST(GltfFuzz, SurvivesNumbersReplacedInTheJson) {
  replaceNumbers(makeRichFile());
  replaceNumbers(makePosedFile());
}

TEST(GltfFuzz, BeginsWithFilesThatLoad) {
  const TempFolder folder;
  for (const GltfFile& file : {makeRichFile(), makePosedFile()}) EXPECT_FALSE(isRefused(writeGlb(folder, file)));
  const scenes::Scene scene = scenes::loadScene(writeGlb(folder, makePosedFile()));
  EXPECT_EQ(scene.instances.size(), 5u) << "the skinned quad, and four of the Draco triangle";
}

TEST(GltfContainer, NamesTheByteWhereAContainerBreaks) {
  const std::vector<std::byte> glb = makeGlb(makeQuad());
  std::vector<std::byte> bad = glb;
  bad[4] = std::byte{1};
  expectError([&] { scenes::splitGlb(bad, "a.glb"); }, {"a.glb: byte 4: glb version 1 is not 2"});
  bad = glb;
  bad[16] = std::byte{'B'};
  expectError([&] { scenes::splitGlb(bad, "a.glb"); }, {"a.glb: byte 16: the first chunk is not JSON"});
  bad = glb;
  bad[15] = std::byte{0x7f};
  expectError([&] { scenes::splitGlb(bad, "a.glb"); }, {"a.glb: byte 12: chunk 0", "ends outside the file"});
  const scenes::GlbChunks chunks = scenes::splitGlb(glb, "a.glb");
  EXPECT_TRUE(chunks.hasBinary);
  EXPECT_EQ(chunks.json.front(), '{');
}

} // namespace
} // namespace parity::tests
