// EXT_mesh_gpu_instancing, and hierarchies of many nodes.
#include <chrono>
#include <cmath>
#include <iostream>

#include "scenes/gltf/gltf_writer.h"
#include "scenes/gltf/nodes.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Scene;

GltfFile makeInstanced(const json& attributes) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  file.json["nodes"][0]["translation"] = {0, 10, 0};
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  return file;
}

TEST(GltfInstancing, PlacesTheMeshByTranslationRotationAndScaleBelowItsNode) {
  GltfFile file = makeInstanced({{"TRANSLATION", 4}, {"ROTATION", 5}, {"SCALE", 6}, {"_ID", 4}});
  const float h = std::sqrt(0.5f);
  file.add<float>({1, 2, 3, 0, 0, 0}, "VEC3");
  file.add<float>({0, 0, h, h, 0, 0, 0, 2}, "VEC4"); // a quarter turn about +Z; none, not unit length
  file.add<float>({2, 2, 2, -1, 1, 1}, "VEC3");
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  const glm::vec4 corner = scene.instances[0].toWorld * glm::vec4(1, 0, 0, 1); // scaled to (2,0,0), turned to (0,2,0)
  EXPECT_NEAR(glm::length(corner - glm::vec4(1, 14, 3, 1)), 0.f, 1e-5f);
  EXPECT_EQ(glm::vec3(scene.instances[1].toWorld * glm::vec4(1, 0, 0, 1)), glm::vec3(-1, 10, 0));
}

TEST(GltfInstancing, ReadsRotationsOfNormalizedIntegers) {
  GltfFile file = makeInstanced({{"ROTATION", 4}});
  file.add<std::int8_t>({0, 0, 127, 0, 0, 0, 0, 127}, "VEC4", true);
  EXPECT_EQ(loadQuadlike(file).instances[0].toWorld[0], glm::vec4(-1, 0, 0, 0));
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
      file.add<std::int16_t>({0, 32767, 0, 0}, "VEC4", true);
  EXPECT_EQ(loadQuadlike(file).instances[0].toWorld[2], glm::vec4(0, 0, -1, 0));
}

TEST(GltfInstancing, RefusesOtherTypesAndCounts) {
  const TempFolder folder;
  const auto refuse = [&](GltfFile file, const std::vector<std::string>& parts) {
    expectError([&] { scenes::loadScene(writeGlb(folder, file)); }, parts);
  };
  refuse(makeInstanced(json::object()), {"/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes: needs TRANSLATION"});
  refuse(makeInstanced({{"TRANSLATION", 2}}), {"TRANSLATION (/accessors/2): expected 3 components"});
  GltfFile file = makeInstanced({{"TRANSLATION", 0}, {"SCALE", 4}});
  file.add<float>({1, 1, 1}, "VEC3");
  refuse(file, {"SCALE (/accessors/4): has 1 elements, but another attribute has 4"});
  file = makeInstanced({{"SCALE", 4}});
  file.add<std::int16_t>({1, 1, 1, 1}, "VEC3", true);
  file.json["accessors"][4]["count"] = 1;
  refuse(file, {"SCALE (/accessors/4): expected FLOAT"});
  file = makeInstanced({{"ROTATION", 4}});
  file.add<float>({0, 0, 0, 0}, "VEC4");
  refuse(file, {"element 0 is a quaternion of length 0"});
  file = makeInstanced({{"TRANSLATION", 4}});
  file.add<float>({0, std::nanf(""), 0}, "VEC3");
  refuse(file, {"element 0 is not finite"});
  file = makeInstanced({{"TRANSLATION", 4}});
  file.json["accessors"].push_back({{"componentType", 5126}, {"count", 2000000}, {"type", "VEC3"}}); // zeros
  refuse(file, {"/nodes: place more than 1048576 primitives"});
}

TEST(GltfHierarchy, HasNoDepthThatIsTooDeep) {
  constexpr int kDepth = 100000;
  GltfFile file = makeQuad();
  file.json["nodes"] = json::array();
  for (int i = 0; i < kDepth; ++i)
    file.json["nodes"].push_back({{"name", "a link of the chain"}, {"translation", {0, 0, 1}}, {"children", {i + 1}}});
  file.json["nodes"].push_back({{"name", "load"}, {"mesh", 0}});
  const TempFolder folder;
  const std::string path = writeGlb(folder, file);
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = scenes::loadScene(path);
  const double timeMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  std::cout << "100,000 nodes in a chain: " << timeMs << " ms\n";
  EXPECT_LT(timeMs, 10000) << "far off what it is meant to take: something is quadratic";
  EXPECT_EQ(scene.instances[0].toWorld[3].z, float(kDepth));
  const std::string& name = scene.instances[0].node;
  EXPECT_LE(name.size(), scenes::kMaxNodePath);
  EXPECT_TRUE(name.starts_with(".../a link of the chain/")) << name;
  EXPECT_TRUE(name.ends_with("/a link of the chain/load")) << name;
}

} // namespace
} // namespace parity::tests
