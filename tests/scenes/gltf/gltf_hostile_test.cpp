// Small files that ask for much work, and rounding and zeros that valid files have: each once a bug here.

#include "scenes/builtin/material_balls.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Scene;

GltfFile withTexture(GltfFile file) {
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(2, 2))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}}};
  return file;
}

// What takes a hundred times as long as it should is no longer a test that ends: the runner's limit is the assert.
TEST(HostileGltf, AnEdgeOfManyTrianglesIsNoQuadraticWork) {
  const TempFolder folder;
  GltfFile file = withTexture(makeQuad());
  file.material()["normalTexture"] = {{"index", 0}};
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1, 1, 0}, "VEC2");
  std::vector<std::uint16_t> indices;
  for (int i = 0; i < 60000; ++i) indices.insert(indices.end(), {0, 1, 2});
  for (int i = 0; i < 60000; ++i) indices.insert(indices.end(), {1, 0, 3}); // no area in uv
  file.primitive()["indices"] = file.add(indices, "SCALAR");
  EXPECT_EQ(scenes::loadScene(writeGlb(folder, file)).triangleCount(), 120000u);
}

TEST(HostileGltf, ManyInstancesAreRefusedBeforeTheyAreRead) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  const int scales = file.add(std::vector<float>(3 * 600000, 1.f), "VEC3");
  file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  file.json["nodes"] = json::array();
  file.json["scenes"][0]["nodes"] = json::array();
  for (int i = 0; i < 1000; ++i) {
    file.json["nodes"].push_back(
        {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"SCALE", scales}}}}}}}});
    file.json["scenes"][0]["nodes"].push_back(i);
  }
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); }, {"/nodes: place more than 1048576 primitives"});
}

TEST(HostileGltf, DecodingTheSameDataAgainAndAgainIsBounded) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  const int positions = file.add(std::vector<float>(3 * 100000, 0.5f), "VEC3");
  const int zeros = file.add<std::uint32_t>({0, 1, 2}, "SCALAR");
  file.json["meshes"][0]["primitives"] = json::array();
  for (int i = 0; i < 2000; ++i)
    file.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", positions}}}, {"indices", zeros}});
  expectError([&] { scenes::loadScene(writeGlb(folder, file), {.maxMemoryBytes = std::size_t{256} << 20}); },
              {"--max-memory"});
}

TEST(HostileGltf, AShortBufferIsOneProblemHoweverManyReadIt) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  const json primitive = file.primitive();
  for (int i = 0; i < 40; ++i) file.json["meshes"][0]["primitives"].push_back(primitive);
  file.json["buffers"] = {{{"uri", "scene.bin"}, {"byteLength", file.bin.size() + 36}}};
  const std::string path = writeExternal(folder, file);
  EXPECT_EQ(base::errorOf([&] { scenes::loadScene(path); }).what(),
            path + ": /buffers/0: holds 140 bytes, expected 176, its byteLength");
}

TEST(HostileGltf, EveryBadNodeIsTold) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["nodes"] = {{{"mesh", 0}, {"rotation", {0, 0, 0, 0}}}, {{"rotation", {0, 0, 0, 0}}}};
  file.json["scenes"][0]["nodes"] = {0, 1};
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); },
              {"/nodes/0/rotation: is a quaternion of length 0", "/nodes/1/rotation: is a quaternion of length 0"});
}

TEST(HostileGltf, GeometryThatLeavesTheNumbersIsRefused) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.primitive()["attributes"]["POSITION"] = file.add<float>({0, 0, 0, 1e30f, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  file.json["nodes"][0]["scale"] = {1e20, 1, 1};
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); },
              {"/nodes/0: places 'quad' farther than 1e+18 m, or at NaN"});
  file.json["nodes"][0]["scale"] = {1, 1, 1};
  expectError([&] { scenes::loadScene(writeGlb(folder, file)); }, {"/nodes/0: places 'quad' farther than 1e+18 m"});
  GltfFile morphed = makeQuad();
  morphed.primitive()["targets"] = {{{"POSITION", morphed.add(std::vector<float>(12, 1e30f), "VEC3")}}};
  morphed.json["nodes"][0]["weights"] = {1e30};
  expectError([&] { scenes::loadScene(writeGlb(folder, morphed, "morphed")); }, {"/nodes/0: places", "or at NaN"});
}

TEST(ValidGltf, AFlattenedMeshIsShownAndWhatHasNoAreaIsNot) {
  const TempFolder folder;
  GltfFile file = makeQuad(); // in z = 0
  file.json["nodes"][0]["scale"] = {1, 1, 0};
  const Scene scene = scenes::loadScene(writeGlb(folder, file));
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(ValidGltf, LightsAndCamerasThatAScaleOf0HidesAreLeftOut) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "directional"}}}}}}};
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  file.json["nodes"].push_back(
      {{"scale", {0, 0, 0}}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.json["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = scenes::loadScene(writeGlb(folder, file));
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_TRUE(scene.cameras.empty());
  EXPECT_TRUE(hasWarning(scene.warnings, "its scale gives its light no direction"));
  EXPECT_TRUE(hasWarning(scene.warnings, "its scale gives its camera no direction"));
}

TEST(ValidGltf, MatricesMayHoldAnExportersRounding) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  file.json["nodes"][0]["matrix"] = {1, 0, 0, 1e-9, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 0.99999994};
  const Scene scene = scenes::loadScene(writeGlb(folder, file));
  EXPECT_EQ(scene.instances.at(0).toWorld[3], glm::vec4(5, 0, 0, 1));
  EXPECT_EQ(scene.instances.at(0).toWorld[0][3], 0.f);
}

TEST(ValidGltf, AKeysOwnTimeIsThatKey) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  const int times = file.add<float>({0, 0.1f, 0.7f}, "SCALAR");
  const int places = file.add<float>({0, 0, 0, 5, 0, 0, 9, 0, 0}, "VEC3");
  file.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}, {"interpolation", "STEP"}}}},
                              {"channels",
                               {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                                {{"sampler", 0}, {"target", {{"node", 0}, {"path", "acme_glow"}}}}}}}};
  const std::string path = writeGlb(folder, file);
  const auto placeAt = [&](double time) {
    return scenes::loadScene(path, {.timeSeconds = time}).instances.at(0).toWorld[3].x;
  };
  EXPECT_EQ(placeAt(0.1), 5.f);
  EXPECT_EQ(placeAt(0.7), 9.f);
  EXPECT_EQ(placeAt(0.0999), 0.f);
  EXPECT_TRUE(hasWarning(scenes::loadScene(path).warnings, "does not animate a node"));
}

TEST(HostileGltf, DerivedImagesCountByTheirOwnSize) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  for (const auto& [width, height] : {std::pair(4096, 1), std::pair(1, 4096)})
    file.json["images"].push_back(
        {{"bufferView", file.addBufferView(makePng(width, height))}, {"mimeType", "image/png"}});
  file.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  file.material()["extensions"] = {
      {"KHR_materials_pbrSpecularGlossiness",
       {{"specularGlossinessTexture", {{"index", 0}}}, {"diffuseTexture", {{"index", 1}}}}}};
  const std::string path = writeGlb(folder, file);
  expectError([&] { scenes::loadScene(path, {.maxImageTexels = 1 << 20}); }, {"/images/1", "(--max-image)"});
  expectError([&] { scenes::loadScene(path, {.maxMemoryBytes = 32 << 20}); }, {"/images/1", "(--max-memory)"});
}

TEST(HostileGltf, TooManyBallsAreRefused) {
  Scene scene;
  scene.name = "many";
  scene.materials.resize(10001);
  expectError([&] { scenes::makeMaterialBalls(scene); }, {"many: /materials: 10001 are too many"});
}

} // namespace
} // namespace parity::tests
