// Small files that ask for much: refused before memory is taken.
#include <cmath>
#include <filesystem>

#include "scenes/gltf/file/json.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/gltf/tangents.h"
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
              {path, "/meshes/0/primitives/", "the limit for a scene is 1024 MiB (--max-memory)"});
}

// 2.4 MB of corners; making tangents takes 172 bytes of each.
TEST(GltfLimits, RefusesTangentsThatTakeMoreThanTheMemoryAllowed) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  std::vector<std::uint8_t> corners;
  for (int i = 0; i < 100000; ++i) corners.insert(corners.end(), {0, 1, 2, 0, 2, 3});
  file.primitive()["indices"] = file.add<std::uint8_t>(corners, "SCALAR");
  const auto load = [&] {
    return scenes::loadScene(writeGlb(folder, file), {.maxMemoryBytes = std::size_t{16} << 20});
  };
  EXPECT_EQ(load().meshes[0].indices.size(), corners.size());
  writeFile(folder / "bumps.png", makePng(2, 2));
  file.json["images"] = {{{"uri", "bumps.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  expectError(load, {"/meshes/0/primitives/0: needs", "(--max-memory)"});
}

// Triangles that share a vertex and no edge, in a uv that turns from one to the next: each corner there gets a tangent
// of its own, and so a vertex.
TEST(GltfLimits, RefusesVerticesThatTangentsSplitBeyondTheMemoryAllowed) {
  constexpr std::uint32_t kTriangles = 20000;
  scenes::Mesh mesh;
  mesh.positions = {{0, 0, 0}};
  mesh.uv0 = {{0, 0}};
  for (std::uint32_t t = 0; t < kTriangles; ++t) {
    for (const float side : {0.f, 0.04f}) {
      const float turn = 0.1f * static_cast<float>(t) + side, uvTurn = 3.1f * static_cast<float>(t) + side;
      mesh.positions.emplace_back(std::cos(turn), std::sin(turn), 0.f);
      mesh.uv0.emplace_back(std::cos(uvTurn), std::sin(uvTurn));
    }
    mesh.indices.insert(mesh.indices.end(), {0, 2 * t + 1, 2 * t + 2});
  }
  mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
  std::size_t told = 0;
  scenes::Mesh split = mesh;
  scenes::makeTangents(split, 0, [&](std::size_t vertices) { told = vertices; });
  EXPECT_GT(told, 1000u);
  EXPECT_EQ(split.positions.size(), mesh.positions.size() + told);
  EXPECT_EQ(split.positions.capacity(), split.positions.size());

  const TempFolder folder;
  GltfFile file = makeQuad();
  std::vector<float> positions, normals, uvs;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    positions.insert(positions.end(), {mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z});
    normals.insert(normals.end(), {0, 0, 1});
    uvs.insert(uvs.end(), {mesh.uv0[v].x, mesh.uv0[v].y});
  }
  file.primitive()["attributes"] = {{"POSITION", file.add<float>(positions, "VEC3")},
                                    {"NORMAL", file.add<float>(normals, "VEC3")},
                                    {"TEXCOORD_0", file.add<float>(uvs, "VEC2")}};
  file.primitive()["indices"] = file.add<std::uint32_t>(mesh.indices, "SCALAR");
  writeFile(folder / "bumps.png", makePng(2, 2));
  file.json["images"] = {{{"uri", "bumps.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  const std::string path = writeGlb(folder, file);
  const auto loads = [&](std::size_t bytes) {
    try {
      scenes::loadScene(path, {.maxMemoryBytes = bytes});
      return true;
    } catch (const base::Error&) {
      return false;
    }
  };
  // The least limit that it loads with holds the new vertices, of 48 bytes each, beside all that there was before.
  std::size_t refused = 0, enough = std::size_t{64} << 20;
  while (enough - refused > 1000) {
    const std::size_t middle = (refused + enough) / 2;
    (loads(middle) ? enough : refused) = middle;
  }
  const std::size_t working = scenes::bytesToMakeTangents(mesh);
  EXPECT_GT(enough, std::filesystem::file_size(path) + working + mesh.positions.size() * 48 + told * 48);
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
  expectError([&] { scenes::parseGltfJson(text + "]", "a.gltf"); }, {"a.gltf: JSON: has more than 8388608 values"});
  const std::string nested(scenes::kMaxJsonDepth + 1, '[');
  expectError([&] { scenes::parseGltfJson(nested, "a.gltf"); }, {"is nested deeper than 64 levels"});
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
