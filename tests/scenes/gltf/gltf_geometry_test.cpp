// Meshes as a glTF file may store them: containers, component types, modes, strides, and what is generated.

#include "scenes/gltf/gltf_writer.h"
#include "scenes/gltf/mesh_repair.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using scenes::Mesh;
using scenes::Scene;

TEST(GltfGeometry, LoadsTheSameFromExternalEmbeddedAndBinaryFiles) {
  const Scene scene = loadQuadlike(makeQuad());
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
  EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.uv0[0], glm::vec2(0, 1));
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_TRUE(mesh.tangents.empty()) << "no normal map needs them";
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(scene.triangleCount(), 2u);
  EXPECT_EQ(scene.name, "scene");
}

template <typename Index> std::vector<std::uint32_t> indicesThrough() {
  GltfFile file = makeQuad();
  file.primitive()["indices"] = file.add<Index>({0, 2, 3}, "SCALAR");
  return loadQuadlike(file).meshes.at(0).indices;
}

TEST(GltfGeometry, ReadsIndicesOfAllTypesAndNone) {
  const std::vector<std::uint32_t> expected = {0, 2, 3};
  EXPECT_EQ(indicesThrough<std::uint8_t>(), expected);
  EXPECT_EQ(indicesThrough<std::uint16_t>(), expected);
  EXPECT_EQ(indicesThrough<std::uint32_t>(), expected);
  GltfFile file = makeQuad();
  file.primitive().erase("indices");
  const Scene scene = loadQuadlike(file); // four vertices: one triangle and a rest
  EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(hasWarning(scene.warnings, "4 indices do not form whole triangles"));
}

TEST(GltfGeometry, TurnsStripsAndFansIntoListsWithTheSameWinding) {
  GltfFile file = makeQuad();
  file.primitive()["indices"] = file.add<std::uint16_t>({0, 1, 3, 2}, "SCALAR");
  file.primitive()["mode"] = 5;
  Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 3, 1, 2, 3}));
  file.primitive()["indices"] = file.add<std::uint16_t>({0, 1, 2, 3}, "SCALAR");
  file.primitive()["mode"] = 6;
  scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
  // All face +Z, as the quad does.
  const Mesh& mesh = scene.meshes[0];
  for (std::size_t t = 0; t < 2; ++t) {
    const glm::vec3 a = mesh.positions[mesh.indices[3 * t]], b = mesh.positions[mesh.indices[3 * t + 1]],
                    c = mesh.positions[mesh.indices[3 * t + 2]];
    EXPECT_GT(glm::cross(b - a, c - a).z, 0);
  }
}

TEST(GltfGeometry, SkipsPointsAndLinesWithAWarning) {
  GltfFile file = makeQuad();
  nlohmann::json lines = file.primitive();
  lines["mode"] = 1;
  file.json["meshes"][0]["primitives"].push_back(lines);
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_TRUE(hasWarning(scene.warnings, "points and lines are not drawn"));
}

// glTF 2.0, 3.6.2.2: c / 255, max(c / 127, -1), c / 65535, max(c / 32767, -1).
TEST(GltfGeometry, DecodesNormalizedIntegersAsTheSpecificationSays) {
  GltfFile file = makeQuad();
  auto& attributes = file.primitive()["attributes"];
  attributes["NORMAL"] = file.addAccessor(
      [] {
        std::vector<std::byte> bytes;
        for (int i = 0; i < 4; ++i) // padded to 4 bytes each
          for (const int c : {0, -128, 0, 0}) bytes.push_back(static_cast<std::byte>(c));
        return bytes;
      }(),
      5120, 4, "VEC3", true);
  file.json["bufferViews"].back()["byteStride"] = 4;
  attributes["TEXCOORD_0"] = file.add<std::uint16_t>({0, 65535, 32768, 0, 13107, 1, 0, 0}, "VEC2", true);
  attributes["COLOR_0"] = file.add<std::uint8_t>({255, 0, 51, 102, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8}, "VEC4", true);
  const Mesh mesh = loadQuadlike(file).meshes[0];
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, -1, 0)) << "-128 is clamped to -1";
  EXPECT_EQ(mesh.uv0[0], glm::vec2(0, 1));
  EXPECT_FLOAT_EQ(mesh.uv0[1].x, 32768.f / 65535.f);
  EXPECT_FLOAT_EQ(mesh.uv0[2].x, 0.2f);
  EXPECT_EQ(mesh.colors[0], glm::vec4(1, 0, 0.2f, 0.4f));

  attributes["TEXCOORD_0"] = file.add<std::uint8_t>({0, 255, 51, 0, 0, 0, 0, 0}, "VEC2", true);
  EXPECT_EQ(loadQuadlike(file).meshes[0].uv0[1], glm::vec2(0.2f, 0.f));
}

TEST(GltfGeometry, ReadsQuantizedPositionsUvsAndTangents) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  auto& attributes = file.primitive()["attributes"];
  attributes["POSITION"] = file.addAccessor(
      [] {
        std::vector<std::byte> bytes;
        for (const std::int16_t c : {0, 0, 0, 0, 100, 0, 0, 0, 100, -300, 0, 0, 0, 100, 0, 0}) {
          bytes.push_back(static_cast<std::byte>(c & 0xff));
          bytes.push_back(static_cast<std::byte>(c >> 8 & 0xff));
        }
        return bytes;
      }(),
      5122, 4, "VEC3");
  file.json["bufferViews"].back()["byteStride"] = 8;
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions[2], glm::vec3(100, -300, 0)) << "not normalised: by value";
}

TEST(GltfGeometry, ReadsInterleavedAttributesByStride) {
  GltfFile file = makeQuad();
  std::vector<float> interleaved;
  for (int i = 0; i < 4; ++i)
    for (const float c : {i == 1 || i == 2 ? 1.f : 0.f, i > 1 ? 1.f : 0.f, 5.f, 0.25f * static_cast<float>(i), 0.5f})
      interleaved.push_back(c);
  std::vector<std::byte> bytes(interleaved.size() * sizeof(float));
  std::memcpy(bytes.data(), interleaved.data(), bytes.size());
  const int view = file.addBufferView(bytes);
  file.json["bufferViews"].back()["byteStride"] = 20;
  const int first = static_cast<int>(file.json["accessors"].size());
  file.json["accessors"].push_back({{"bufferView", view}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  file.json["accessors"].push_back(
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  file.primitive()["attributes"]["POSITION"] = first;
  file.primitive()["attributes"]["TEXCOORD_0"] = first + 1;
  const Mesh mesh = loadQuadlike(file).meshes[0];
  EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 5));
  EXPECT_EQ(mesh.uv0[3], glm::vec2(0.75f, 0.5f));
}

TEST(GltfGeometry, ReadsBothUvSetsAndGivesRgbColorsAnAlphaOfOne) {
  GltfFile file = makeQuad();
  auto& attributes = file.primitive()["attributes"];
  attributes["TEXCOORD_1"] = file.add<float>({9, 8, 7, 6, 5, 4, 3, 2}, "VEC2");
  attributes["COLOR_0"] = file.add<float>({.1f, .2f, .3f, 1, 1, 1, 1, 1, 1, 1, 1, 1}, "VEC3");
  const Mesh mesh = loadQuadlike(file).meshes[0];
  EXPECT_EQ(mesh.uv1[0], glm::vec2(9, 8));
  EXPECT_EQ(mesh.colors[0], glm::vec4(.1f, .2f, .3f, 1));
}

TEST(GltfGeometry, GeneratesFlatNormalsAndSplitsVerticesWhereNormalsAreAbsent) {
  GltfFile file = makeQuad();
  file.primitive()["attributes"]["POSITION"] = file.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1}, "VEC3");
  file.primitive()["attributes"].erase("NORMAL");
  const Mesh mesh = loadQuadlike(file).meshes[0];
  ASSERT_EQ(mesh.positions.size(), 6u);
  for (std::size_t t = 0; t < 2; ++t) {
    const glm::vec3 a = mesh.positions[3 * t], b = mesh.positions[3 * t + 1], c = mesh.positions[3 * t + 2];
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(glm::length(mesh.normals[3 * t + k]), 1.f, 1e-6f);
      EXPECT_NEAR(glm::dot(mesh.normals[3 * t + k], b - a), 0.f, 1e-6f);
      EXPECT_NEAR(glm::dot(mesh.normals[3 * t + k], c - a), 0.f, 1e-6f);
    }
  }
  EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.uv0[4], glm::vec2(1, 0)) << "corner 4 was vertex 2";
}

TEST(GltfGeometry, NormalizesNormalsAndReplacesThoseWithoutLengthOrNotFinite) {
  GltfFile file = makeQuad();
  file.primitive()["attributes"]["NORMAL"] = file.add<float>({0, 0, 5, 0, 0, 0, std::nanf(""), 0, 1, 3, 0, 4}, "VEC3");
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.meshes[0].normals[1], glm::vec3(0, 0, 1)) << "its face's";
  EXPECT_EQ(scene.meshes[0].normals[2], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.meshes[0].normals[3], glm::vec3(0.6f, 0, 0.8f));
  EXPECT_TRUE(hasWarning(scene.warnings, "1 normal of length 0 and 1 that is NaN or infinite"));
}

TEST(GltfGeometry, MakesOneMeshAPrimitiveAndADefaultMaterialWhereNoneIsGiven) {
  GltfFile file = makeQuad();
  nlohmann::json second = file.primitive();
  second.erase("material");
  file.json["meshes"][0]["primitives"].push_back(second);
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.meshes.size(), 2u);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.meshes[1].material, 1u);
  EXPECT_EQ(scene.materials[1].name, "default material");
  EXPECT_EQ(scene.materials[1].metallic, 1.f) << "glTF's default";
  EXPECT_EQ(scene.meshes[0].name, "quad [0]");
  EXPECT_EQ(scene.instances.size(), 2u);
}

TEST(MeshRepair, TriangulatesStripsByTheSpecificationsFormula) {
  EXPECT_EQ(scenes::listFromStrip({0, 1, 2, 3, 4}), (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(scenes::listFromFan({7, 1, 2, 3}), (std::vector<std::uint32_t>{1, 2, 7, 2, 3, 7}));
  EXPECT_TRUE(scenes::listFromStrip({0, 1}).empty());
  EXPECT_TRUE(scenes::listFromFan({}).empty());
}

} // namespace
} // namespace parity::tests
