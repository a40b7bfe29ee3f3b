// Small sound glTF files: geometry in every storage, poses, instances.
#include <stdexcept>

#include <meshoptimizer.h>

#include "fuzz/seed_parts.h"
#include "scenes/gltf/draco_writer.h"

namespace parity::tests {

using nlohmann::json;

GltfFile makeInterleaved() {
  GltfFile file = makeTextured(makePng(2, 2), "image/png");
  const std::vector<float> values = {0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1, 1, 0, 1, 0, 0, 1};
  const int view = file.addBufferView(toBytes(values));
  file.json["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 20;
  file.json["accessors"][0].update({{"bufferView", view}, {"min", {0, 0, 0}}, {"max", {1, 1, 0}}});
  file.json["accessors"][2].update({{"bufferView", view}, {"byteOffset", 12}});
  file.material()["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
  json& attributes = file.primitive()["attributes"];
  attributes.erase("NORMAL");
  attributes["COLOR_0"] = file.add<std::uint8_t>(std::vector<std::uint8_t>(16, 200), "VEC4", true);
  attributes["TEXCOORD_1"] = file.add<std::uint16_t>({0, 0, 65535, 0, 65535, 65535, 0, 65535}, "VEC2", true);
  return file;
}

GltfFile makeQuantized() {
  GltfFile file = makeQuad();
  use(file, {"KHR_mesh_quantization"}, true);
  json& attributes = file.primitive()["attributes"];
  attributes["POSITION"] = file.addAccessor(
      toBytes(std::vector<std::int16_t>{0, 0, 0, 0, 9, 0, 0, 0, 9, 9, 0, 0, 0, 9, 0, 0}), 5122, 4, "VEC3");
  file.json["bufferViews"].back()["byteStride"] = 8;
  attributes["NORMAL"] = file.addAccessor(
      toBytes(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}), 5120, 4, "VEC3", true);
  file.json["bufferViews"].back()["byteStride"] = 4;
  return file;
}

GltfFile makeSparse() {
  GltfFile file = makeQuad();
  const int indices = file.addBufferView(toBytes(std::vector<std::uint8_t>{1, 3}));
  const int values = file.addBufferView(toBytes(std::vector<float>{2, 0, 1, 0, 3, 1}));
  file.json["accessors"][0]["sparse"] = {{"count", 2},
                                         {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                         {"values", {{"bufferView", values}}}};
  file.json["accessors"][1].erase("bufferView");
  file.json["accessors"][1]["sparse"] = file.json["accessors"][0]["sparse"];
  return file;
}

namespace {

void animate(GltfFile& file, const char* path, const std::vector<float>& values, const char* type,
             const char* interpolation, int node) {
  const int input = file.add<float>({0, 1}, "SCALAR"), output = file.add<float>(values, type);
  if (!file.json.contains("animations"))
    file.json["animations"] = {{{"channels", json::array()}, {"samplers", json::array()}, {"name", "a"}}};
  json& animation = file.json["animations"][0];
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

} // namespace

GltfFile makeMorphed() {
  GltfFile file = makeQuad();
  const int up = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.primitive()["targets"] = {{{"POSITION", up}, {"NORMAL", up}}, {{"POSITION", up}}};
  file.json["meshes"][0]["weights"] = {0.5, 0};
  file.json["nodes"][0]["weights"] = {0.5, 1};
  animate(file, "weights", {0, 0, 1, 1}, "SCALAR", "LINEAR", 0);
  return file;
}

GltfFile makeSkinned() {
  GltfFile file = makeQuad();
  json& attributes = file.primitive()["attributes"];
  attributes["JOINTS_0"] = file.add<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  attributes["WEIGHTS_0"] = file.add<float>({1, 0, 0, 0, .5f, .5f, 0, 0, 0, 1, 0, 0, .5f, .5f, 0, 0}, "VEC4");
  std::vector<float> matrices;
  for (int joint = 0; joint < 2; ++joint)
    for (int i = 0; i < 16; ++i) matrices.push_back(i % 5 == 0 ? 1.f : 0.f);
  file.json["skins"] = {
      {{"joints", {1, 2}}, {"skeleton", 1}, {"inverseBindMatrices", file.add<float>(matrices, "MAT4")}}};
  file.json["nodes"][0]["skin"] = 0;
  file.json["nodes"].push_back({{"children", {2}}});
  file.json["nodes"].push_back({{"translation", {0, 1, 0}}});
  file.json["scenes"][0]["nodes"] = {0, 1};
  animate(file, "translation", {0, 0, 0, 1, 0, 0}, "VEC3", "LINEAR", 1);
  animate(file, "rotation", {0, 0, 0, 1, 0, 0, 1, 0}, "VEC4", "STEP", 2);
  animate(file, "scale", {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0}, "VEC3", "CUBICSPLINE", 2);
  return file;
}

GltfFile makeInstanced() {
  GltfFile file = makeQuad();
  use(file, {"EXT_mesh_gpu_instancing"}, true);
  const int move = file.add<float>({1, 2, 3, 0, 0, 0}, "VEC3"),
            turn = file.add<float>({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", move}, {"ROTATION", turn}, {"SCALE", file.add<float>({1, 1, 1, 2, 2, 2}, "VEC3")}, {"_ID", move}};
  return file;
}

GltfFile makeDraco(bool edgebreaker) {
  GltfFile file = makeQuad();
  use(file, {"KHR_draco_mesh_compression"}, true);
  const DracoSource source{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                           std::vector<glm::vec3>(4, {0, 0, 1}),
                           {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
                           {},
                           {0, 1, 2, 0, 2, 3}};
  const int view = file.addBufferView(encodeDraco(source, edgebreaker, edgebreaker ? 11 : 0));
  for (json& accessor : file.json["accessors"]) accessor.erase("bufferView");
  file.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}};
  return file;
}

namespace {

// Replaces the view of an accessor by a compressed one of `count` elements.
void pack(GltfFile& file, std::size_t accessor, std::vector<unsigned char> stream, std::size_t written, json layout) {
  if (written == 0) throw std::runtime_error("meshoptimizer encodes nothing");
  stream.resize(written);
  const auto view = static_cast<std::size_t>(file.addBufferView(toBytes(stream)));
  layout.update({{"buffer", 0}, {"byteOffset", file.json["bufferViews"][view]["byteOffset"]}, {"byteLength", written}});
  json& out = file.json["bufferViews"][view];
  out = {
      {"buffer", 0}, {"byteOffset", 0}, {"byteLength", layout["count"].get<int>() * layout["byteStride"].get<int>()}};
  out["extensions"]["EXT_meshopt_compression"] = layout;
  file.json["accessors"][accessor]["bufferView"] = view;
}

} // namespace

GltfFile makeMeshopt(const char* filter) {
  GltfFile file = makeQuad();
  use(file, {"EXT_meshopt_compression", "KHR_mesh_quantization"}, true);
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  std::vector<float> stored = positions;
  if (filter) meshopt_encodeFilterExp(stored.data(), 4, 12, 15, positions.data());
  std::vector<unsigned char> stream(meshopt_encodeVertexBufferBound(4, 12));
  std::size_t written = meshopt_encodeVertexBuffer(stream.data(), stream.size(), stored.data(), 4, 12);
  json layout = {{"count", 4}, {"byteStride", 12}, {"mode", "ATTRIBUTES"}};
  if (filter) layout["filter"] = filter;
  pack(file, 0, stream, written, layout);

  const std::vector<float> normals = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<std::int8_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
  stream.assign(meshopt_encodeVertexBufferBound(4, 4), 0);
  written = meshopt_encodeVertexBuffer(stream.data(), stream.size(), octahedral.data(), 4, 4);
  pack(file, 1, stream, written, {{"count", 4}, {"byteStride", 4}, {"mode", "ATTRIBUTES"}, {"filter", "OCTAHEDRAL"}});
  file.json["accessors"][1].update({{"componentType", 5120}, {"normalized", true}});

  const std::vector<unsigned> indices = {0, 1, 2, 0, 2, 3};
  stream.assign(meshopt_encodeIndexBufferBound(6, 4), 0);
  written = filter ? meshopt_encodeIndexSequence(stream.data(), stream.size(), indices.data(), 6)
                   : meshopt_encodeIndexBuffer(stream.data(), stream.size(), indices.data(), 6);
  pack(file, 3, stream, written, {{"count", 6}, {"byteStride", 2}, {"mode", filter ? "INDICES" : "TRIANGLES"}});
  return file;
}

} // namespace parity::tests
