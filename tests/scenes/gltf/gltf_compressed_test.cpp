// Files whose geometry is compressed: the same mesh comes out as from plain accessors.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <meshoptimizer.h>

#include "scenes/builtin/shapes.h"
#include "scenes/gltf/draco_writer.h"
#include "scenes/gltf/expect_refused.h"
#include "scenes/gltf/file/draco.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Scene;

// The quad as a Draco stream; its accessors lose their buffer views, but that of the uv, which the stream lacks.
GltfFile makeDracoQuad() {
  GltfFile file = makeQuad();
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const DracoSource source{positions, std::vector<glm::vec3>(4, {0, 0, 1}), {}, {}, {0, 1, 2, 0, 2, 3}};
  const int view = file.addBufferView(encodeDraco(source, false)); // sequential: the order is kept
  for (const std::size_t accessor : {0u, 1u, 3u}) file.json["accessors"][accessor].erase("bufferView");
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                                  {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
  return file;
}

TEST(GltfDraco, GivesTheSameSceneAsPlainAccessors) {
  const Scene plain = loadQuadlike(makeQuad()), packed = loadQuadlike(makeDracoQuad());
  EXPECT_EQ(packed.meshes[0].positions, plain.meshes[0].positions);
  EXPECT_EQ(packed.meshes[0].normals, plain.meshes[0].normals);
  EXPECT_EQ(packed.meshes[0].uv0, plain.meshes[0].uv0) << "from its accessor";
  EXPECT_EQ(packed.meshes[0].indices, plain.meshes[0].indices);
  EXPECT_TRUE(packed.warnings.empty());
}

// Beside the mesh itself, 40 bytes a vertex and 4 an index, there are libdraco's mesh and our copy of it.
TEST(GltfDraco, CountsWhatIsDecoded) {
  const scenes::Mesh sphere = scenes::makeSphere(1, 256, 129);
  const std::size_t vertices = sphere.positions.size(), corners = sphere.indices.size();
  GltfFile file = makeQuad();
  const DracoSource source{sphere.positions, sphere.normals, {}, {}, sphere.indices};
  const int view = file.addBufferView(encodeDraco(source, false));
  file.primitive()["attributes"].erase("TEXCOORD_0");
  file.json["accessors"].erase(2);
  for (const std::size_t accessor : {0u, 1u, 2u}) {
    file.json["accessors"][accessor].erase("bufferView");
    file.json["accessors"][accessor]["count"] = accessor == 2 ? corners : vertices;
  }
  file.primitive()["indices"] = 2;
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                                  {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}};
  const TempFolder folder;
  const std::string path = writeGlb(folder, file);
  const std::size_t mesh = vertices * 40 + corners * 4;
  const std::size_t decoded = vertices * (64 + 2 * scenes::dracoBytesOfVertex(3, 4) + 24) + 2 * corners * 4;
  const std::size_t fileBytes = std::filesystem::file_size(path);
  EXPECT_EQ(scenes::loadScene(path, {.maxMemoryBytes = mesh + decoded + 2 * fileBytes}).meshes[0].indices.size(),
            corners);
  expectError([&] { scenes::loadScene(path, {.maxMemoryBytes = mesh + decoded}); },
              {"/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: needs", "(--max-memory)"});
}

TEST(GltfDraco, IsPreferredToWhatTheAccessorsHold) {
  GltfFile file = makeDracoQuad();
  file.json.erase("extensionsRequired");
  file.json["accessors"][0]["bufferView"] = 1; // the normals' bytes, as a fallback
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions[2], glm::vec3(1, 1, 0));
}

TEST(GltfDraco, RefusesStreamsThatAreNotWhatTheAccessorsSay) {
  GltfFile file = makeDracoQuad();
  json& extension = file.primitive()["extensions"]["KHR_draco_mesh_compression"];
  const json good = extension;
  const std::string place = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
  file.json["accessors"][3]["count"] = 3;
  expectRefused(file, {place + ": the stream has 2 triangles, but the accessor has 3 indices"});
  file.json["accessors"][3]["count"] = 6;
  extension["attributes"]["NORMAL"] = 7;
  expectRefused(file, {place + ": the stream has no attribute 7"});
  extension = good;
  extension["attributes"]["TANGENT"] = 1;
  expectRefused(file, {place + "/attributes: names an attribute that the primitive does not have"});
  extension = good;
  extension["bufferView"] = 2;
  expectRefused(file, {place + ": is not a Draco stream"});
  extension = good;
  extension["bufferView"] = 99;
  expectRefused(file, {place + "/bufferView: is 99, expected an index of bufferViews"});
  extension = good;
  file.primitive()["mode"] = 6;
  expectRefused(file, {"/meshes/0/primitives/0/mode: expected TRIANGLES or TRIANGLE_STRIP"});
  file.primitive()["mode"] = 4;
  file.json["accessors"][0]["count"] = file.json["accessors"][1]["count"] = 1000000;
  expectRefused(file, {place + ": the stream has 4 vertices, but the accessors have 1000000"});
}

// A buffer view of `bytes` that decodes to count * stride bytes. The buffer it names itself holds nothing.
template <typename Layout>
std::size_t addPacked(GltfFile& file, const std::vector<unsigned char>& bytes, const Layout& layout) {
  std::vector<std::byte> raw(bytes.size());
  std::memcpy(raw.data(), bytes.data(), bytes.size());
  const int stream = file.addBufferView(raw);
  json extension = layout;
  extension["buffer"] = 0;
  extension["byteOffset"] = file.json["bufferViews"][static_cast<std::size_t>(stream)]["byteOffset"];
  extension["byteLength"] = bytes.size();
  json& view = file.json["bufferViews"][static_cast<std::size_t>(stream)];
  const std::size_t length =
      layout["count"].template get<std::size_t>() * layout["byteStride"].template get<std::size_t>();
  view = {{"buffer", 0},
          {"byteOffset", 0},
          {"byteLength", length},
          {"extensions", {{"EXT_meshopt_compression", extension}}}};
  return static_cast<std::size_t>(stream);
}

// A sphere whose positions are plain, exponential or not, its normals octahedral 8-bit numbers, its indices packed.
GltfFile makeMeshoptSphere(const scenes::Mesh& mesh, bool exponential) {
  const std::size_t count = mesh.positions.size();
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  const auto encode = [&](const void* data, std::size_t stride) {
    std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), data, count, stride));
    return out;
  };
  std::vector<glm::vec3> filtered(count);
  meshopt_encodeFilterExp(filtered.data(), count, 12, 20, &mesh.positions[0].x);
  json layout = {{"count", count}, {"byteStride", 12}, {"mode", "ATTRIBUTES"}};
  if (exponential) layout["filter"] = "EXPONENTIAL";
  const std::size_t positions =
      addPacked(file, encode(exponential ? filtered.data() : mesh.positions.data(), 12), layout);

  std::vector<glm::vec4> normals;
  for (const glm::vec3& n : mesh.normals) normals.emplace_back(n, 0);
  std::vector<std::int8_t> octahedral(4 * count);
  meshopt_encodeFilterOct(octahedral.data(), count, 4, 8, &normals[0].x);
  const std::size_t packedNormals =
      addPacked(file, encode(octahedral.data(), 4),
                json{{"count", count}, {"byteStride", 4}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}});
  file.json["bufferViews"][packedNormals]["byteStride"] = 4;

  std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(mesh.indices.size(), count));
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), mesh.indices.data(), mesh.indices.size()));
  const std::size_t packedIndices =
      addPacked(file, indices, json{{"count", mesh.indices.size()}, {"byteStride", 2}, {"mode", "TRIANGLES"}});
  file.json["accessors"] = {
      {{"bufferView", positions}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}},
      {{"bufferView", packedNormals},
       {"componentType", 5120},
       {"normalized", true},
       {"count", count},
       {"type", "VEC3"}},
      {{"bufferView", packedIndices}, {"componentType", 5123}, {"count", mesh.indices.size()}, {"type", "SCALAR"}}};
  file.primitive()["attributes"] = {{"POSITION", 0}, {"NORMAL", 1}};
  file.primitive()["indices"] = 2;
  file.bin.resize(std::max(file.bin.size(), 12 * count + 2 * mesh.indices.size())); // the views' own, never read
  return file;
}

TEST(GltfMeshopt, GivesTheMeshThatWasPacked) {
  const scenes::Mesh sphere = scenes::makeSphere(1.5, 40, 21);
  for (const bool exponential : {false, true}) {
    const Scene scene = loadQuadlike(makeMeshoptSphere(sphere, exponential));
    const scenes::Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.positions.size(), sphere.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      EXPECT_NEAR(glm::length(mesh.positions[v] - sphere.positions[v]), 0.f, exponential ? 1e-5f : 0.f);
      EXPECT_GT(glm::dot(mesh.normals[v], sphere.normals[v]), std::cos(0.02f)) << "8 bits";
    }
    ASSERT_EQ(mesh.indices.size(), sphere.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) // the encoder may turn triangles
      EXPECT_EQ(mesh.indices[i] + mesh.indices[i + 1] + mesh.indices[i + 2],
                sphere.indices[i] + sphere.indices[i + 1] + sphere.indices[i + 2]);
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(GltfMeshopt, NeedsNoBytesInTheBufferOfTheFallback) {
  GltfFile file = makeMeshoptSphere(scenes::makeSphere(1, 12, 7), false);
  const TempFolder folder;
  const std::string path = writeExternal(folder, file);
  json document = json::parse(std::ifstream(path));
  std::size_t length = 0;
  for (json& view : document["bufferViews"]) {
    if (!view.contains("extensions")) continue;
    view["buffer"] = 1;
    view["byteOffset"] = length;
    length += (view["byteLength"].get<std::size_t>() + 3) / 4 * 4;
  }
  document["buffers"].push_back(
      {{"byteLength", length}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  writeFile(path, document.dump());
  EXPECT_EQ(scenes::loadScene(path).triangleCount(), 12u * 2 * 6);
}

TEST(GltfMeshopt, RefusesLayoutsAndStreamsThatAreWrong) {
  const GltfFile good = makeMeshoptSphere(scenes::makeSphere(1, 12, 7), false);
  const std::size_t positions = good.json["accessors"][0]["bufferView"].get<std::size_t>();
  const std::string place = "/bufferViews/" + std::to_string(positions) + "/extensions/EXT_meshopt_compression";
  const auto refuse = [&](const std::function<void(json & view, json & extension)>& edit,
                          const std::vector<std::string>& parts) {
    GltfFile file = good;
    json& view = file.json["bufferViews"][positions];
    edit(view, view["extensions"]["EXT_meshopt_compression"]);
    expectRefused(file, parts);
  };
  refuse([](json&, json& e) { e["count"] = 5; },
         {place + ": decodes to 60 bytes, expected 1248, the byteLength of the view"});
  refuse([](json& v, json& e) { e["byteStride"] = 6, v["byteLength"] = 624; },
         {place + ": its byteStride 6 is not a multiple of 4"});
  refuse([](json& v, json&) { v["byteStride"] = 16; }, {place + "/byteStride: is 12, expected 16 as in the view"});
  refuse([](json&, json& e) { e["mode"] = "POINTS"; }, {place + "/mode"});
  refuse([](json&, json& e) { e["filter"] = "OCTAHEDRAL"; },
         {place + ": the filter OCTAHEDRAL cannot have a byteStride of 12"});
  refuse([](json&, json& e) { e["byteLength"] = 100000; }, {place + ": ends at byte"});
  refuse([](json&, json& e) { e["byteLength"] = e["byteLength"].get<int>() - 1; },
         {place + ": the stream is damaged, or does not hold ATTRIBUTES of 104 elements"});
  refuse([](json& v, json& e) { e["count"] = 100000000, v["byteLength"] = 1200000000; }, {place});
}

} // namespace
} // namespace parity::tests
