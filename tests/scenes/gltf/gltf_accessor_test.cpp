// Accessors that are put together: sparse, without data, interleaved; and what is wrong with them.
#include <limits>

#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using scenes::Scene;

template <typename T> int addView(GltfFile& file, const std::vector<T>& values) {
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return file.addBufferView(bytes);
}

// Elements `indices` of the quad's positions are replaced.
template <typename Index>
nlohmann::json sparseOf(GltfFile& file, const std::vector<Index>& indices, const std::vector<float>& values) {
  return {{"count", indices.size()},
          {"indices", {{"bufferView", addView(file, indices)}, {"componentType", GltfFile::componentTypeOf(Index{})}}},
          {"values", {{"bufferView", addView(file, values)}}}};
}

TEST(GltfAccessor, PutsSparseElementsOverItsOwnOnes) {
  GltfFile file = makeQuad();
  file.json["accessors"][0]["sparse"] = sparseOf<std::uint8_t>(file, {1, 3}, {2, 0, 1, 0, 3, 1});
  const std::vector<glm::vec3> expected = {{0, 0, 0}, {2, 0, 1}, {1, 1, 0}, {0, 3, 1}};
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions, expected);
  file.json["accessors"][0]["sparse"] = sparseOf<std::uint16_t>(file, {1, 3}, {2, 0, 1, 0, 3, 1});
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions, expected);
  file.json["accessors"][0]["sparse"] = sparseOf<std::uint32_t>(file, {1, 3}, {2, 0, 1, 0, 3, 1});
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions, expected);
}

TEST(GltfAccessor, IsZeroWhereItHasNoData) {
  GltfFile file = makeQuad();
  file.json["accessors"][0].erase("bufferView");
  file.json["accessors"][0]["sparse"] = sparseOf<std::uint8_t>(file, {1, 2}, {2, 0, 1, 0, 3, 1});
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions,
            (std::vector<glm::vec3>{{0, 0, 0}, {2, 0, 1}, {0, 3, 1}, {0, 0, 0}}));
  file.json["accessors"][0].erase("sparse");
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions, std::vector<glm::vec3>(4, glm::vec3(0)));
}

TEST(GltfAccessor, ReadsSparseIndicesOfTriangles) {
  GltfFile file = makeQuad();
  file.json["accessors"][3]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", addView<std::uint8_t>(file, {5})}, {"componentType", 5121}}},
      {"values", {{"bufferView", addView<std::uint16_t>(file, {1})}}}};
  EXPECT_EQ(loadQuadlike(file).meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 1}));
}

TEST(GltfAccessor, ReadsInterleavedAttributesEvenUnderASparsePart) {
  GltfFile file = makeQuad();
  std::vector<float> interleaved; // position, uv
  for (const glm::vec2& p : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)})
    interleaved.insert(interleaved.end(), {p.x, p.y, 7, p.x, 1 - p.y});
  const int view = addView(file, interleaved);
  file.json["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 20;
  file.json["accessors"][0]["bufferView"] = file.json["accessors"][2]["bufferView"] = view;
  file.json["accessors"][2]["byteOffset"] = 12;
  file.json["accessors"][0]["sparse"] = sparseOf<std::uint8_t>(file, {0}, {9, 9, 9});
  const scenes::Mesh mesh = loadQuadlike(file).meshes[0];
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{9, 9, 9}, {1, 0, 7}, {1, 1, 7}, {0, 1, 7}}));
  EXPECT_EQ(mesh.uv0, (std::vector<glm::vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
}

void expectEditRefused(const std::function<void(GltfFile&)>& edit, const std::vector<std::string>& parts) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  edit(file);
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); }, parts);
}

TEST(GltfAccessor, RefusesSparseIndicesThatDoNotIncreaseOrLeaveIt) {
  const auto withIndices = [](const std::vector<std::uint8_t>& indices) {
    return [indices](GltfFile& file) {
      file.json["accessors"][0]["sparse"] = sparseOf(file, indices, std::vector<float>(indices.size() * 3));
    };
  };
  expectEditRefused(withIndices({1, 1}),
                    {"POSITION (/accessors/0): sparse index 1 at 1 is not above the previous one"});
  expectEditRefused(withIndices({2, 1}), {"sparse index 1 at 1 is not above the previous one"});
  expectEditRefused(withIndices({1, 4}), {"sparse index 4 at 1 is out of range, expected increasing indices below 4"});
  expectEditRefused(withIndices({0, 1, 2, 3, 4}), {"/accessors/0/sparse/count: is 5, expected 1 to 4"});
  expectEditRefused(
      [&](GltfFile& file) {
        withIndices({1, 3})(file);
        file.json["accessors"][0]["sparse"]["values"]["byteOffset"] = 4;
      },
      {"/accessors/0/sparse/values: 2 elements of 12 bytes"});
  expectEditRefused(
      [&](GltfFile& file) {
        withIndices({1, 3})(file);
        file.json["accessors"][0]["sparse"]["indices"]["componentType"] = 5126;
      },
      {"/accessors/0/sparse/indices/componentType"});
  expectEditRefused(
      [](GltfFile& file) {
        file.json["accessors"][0]["sparse"] =
            sparseOf<std::uint8_t>(file, {1}, {0, std::numeric_limits<float>::infinity(), 0});
      },
      {"POSITION (/accessors/0): element 1 is not finite"});
}

TEST(GltfAccessor, RefusesZerosBeyondTheMemoryAllowed) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  for (const int a : {0, 1, 2}) {
    file.json["accessors"][static_cast<std::size_t>(a)].erase("bufferView");
    file.json["accessors"][static_cast<std::size_t>(a)]["count"] = 2000000000;
  }
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); }, {"/meshes/0/primitives/0: needs", "(--max-memory)"});
}

TEST(GltfAccessor, CountsWhatItPutsTogether) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["accessors"].push_back({{"componentType", 5126}, {"count", 100000}, {"type", "VEC3"}}); // 1.2 MB of zeros
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 4}};
  expectError([&] { scenes::loadScene(writeGlb(folder, file), {.maxMemoryBytes = 1 << 20}); },
              {"TRANSLATION (/accessors/4): needs 2 MiB in addition to", "(--max-memory)"});
}

TEST(GltfAccessor, RefusesIndicesThatWouldRestartThePrimitive) {
  expectEditRefused(
      [](GltfFile& f) {
        f.primitive()["indices"] = f.add<std::uint8_t>({0, 1, 255}, "SCALAR");
      },
      {"indices (/accessors/4): index 255 at element 2 is the primitive restart value, which glTF forbids"});
  expectEditRefused(
      [](GltfFile& f) {
        f.primitive()["indices"] = f.add<std::uint16_t>({0, 65535, 2}, "SCALAR");
      },
      {"index 65535 at element 1 is the primitive restart value"});
  expectEditRefused(
      [](GltfFile& f) { // also where there is such a vertex
        f.primitive()["attributes"] = {{"POSITION", f.add<float>(std::vector<float>(900, 1), "VEC3")}};
        f.primitive()["indices"] = f.add<std::uint8_t>({0, 1, 255}, "SCALAR");
      },
      {"index 255 at element 2 is the primitive restart value"});
}

TEST(GltfAccessor, SaysWherePositionsLeaveTheirDeclaredLimits) {
  GltfFile file = makeQuad();
  file.json["accessors"][0]["min"] = {0, 0, 0};
  file.json["accessors"][0]["max"] = {1, 0.99999, 0};
  EXPECT_TRUE(loadQuadlike(file).warnings.empty()) << "a rounding";
  file.json["accessors"][0]["max"] = {1, 0.5, 0};
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(hasWarning(scene.warnings,
                         "POSITION (/accessors/0): its values go from 0 to 1 in y, outside its min and max, 0 "
                         "and 0.5"));
}

TEST(GltfAccessor, JudgesComponentTypesByTheNameOfTheAttribute) {
  GltfFile file = makeQuad();
  file.primitive()["attributes"]["NORMAL"] =
      file.add<std::int8_t>({0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}, "VEC4", true);
  file.json["accessors"].back()["type"] = "VEC3";
  file.json["bufferViews"].back()["byteStride"] = 4;
  EXPECT_TRUE(hasWarning(loadQuadlike(file).warnings, "needs KHR_mesh_quantization, which the file does not declare"));
  file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  EXPECT_TRUE(loadQuadlike(file).warnings.empty());
  file.json["accessors"].back()["normalized"] = false;
  const TempFolder folder;
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); },
              {"NORMAL (/accessors/4): has the componentType 5120, which NORMAL cannot have"});
  expectEditRefused(
      [](GltfFile& f) {
        f.primitive()["attributes"]["POSITION"] = f.add<std::uint32_t>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
      },
      {"has the componentType 5125, which POSITION cannot have"});
  expectEditRefused(
      [](GltfFile& f) {
        f.primitive()["attributes"]["COLOR_0"] = f.add<std::uint8_t>(std::vector<std::uint8_t>(16, 9), "VEC4");
      },
      {"has the componentType 5121, which COLOR_0 cannot have"});
}

} // namespace
} // namespace parity::tests
