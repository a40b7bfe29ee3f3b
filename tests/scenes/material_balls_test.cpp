// Every material on a sphere of its own; what a scene says about itself.
#include "scenes/builtin/material_balls.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"
#include "scenes/scene_info.h"
#include "scenes/view.h"

namespace parity::tests {
namespace {

using scenes::Scene;

// Five materials, of which the quad shows one; the last one's normal map is read by nothing shown.
GltfFile makeFive() {
  GltfFile file = makeQuad();
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(8, 2))}, {"mimeType", "image/png"}, {"name", "n"}}};
  file.json["textures"] = {{{"source", 0}}};
  for (int i = 1; i < 5; ++i) file.json["materials"].push_back({{"name", "other"}});
  file.json["materials"][4]["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
  file.json["materials"][2]["alphaMode"] = "BLEND";
  file.json["materials"][2]["doubleSided"] = true;
  file.json["materials"][3] = {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}, {"emissiveFactor", {0, 1, 0}}};
  return file;
}

TEST(MaterialBalls, ShowEveryMaterialOnceWithinTheView) {
  const TempFolder folder;
  const Scene scene =
      scenes::makeMaterialBalls(scenes::loadScene(writeGlb(folder, makeFive()), {.allMaterials = true}));
  ASSERT_EQ(scene.instances.size(), 5u);
  const scenes::Camera camera = scenes::makeCamera(scene, {}, 1);
  for (std::size_t m = 0; m < 5; ++m) {
    const scenes::Instance& instance = scene.instances[m];
    EXPECT_EQ(scene.meshes[instance.mesh].material, m);
    const glm::vec3 center(glm::inverse(camera.toWorld) * instance.toWorld[3]);
    EXPECT_LE(std::abs(center.x) + 0.46f, camera.halfHeight);
    EXPECT_LE(std::abs(center.y) + 0.46f, camera.halfHeight);
    EXPECT_GT(-center.z - 0.46f, camera.zNear);
    EXPECT_LT(-center.z, camera.zFar);
    for (std::size_t other = 0; other < m; ++other)
      EXPECT_GT(glm::distance(instance.toWorld[3], scene.instances[other].toWorld[3]), 0.92f) << "apart";
  }
  const scenes::Mesh& mapped = scene.meshes[4];
  ASSERT_EQ(mapped.tangents.size(), mapped.positions.size());
  EXPECT_EQ(scene.images.at(0).pixels.width, 8) << "its image is read though no mesh shows it";
  for (std::size_t i = 0; i < mapped.positions.size(); ++i) {
    EXPECT_NEAR(glm::length(mapped.positions[i]), 0.46f, 1e-4f);
    EXPECT_NEAR(glm::dot(mapped.normals[i], glm::vec3(mapped.tangents[i])), 0, 1e-3f);
  }
  Scene empty;
  empty.name = "void";
  expectError([&] { scenes::makeMaterialBalls(empty); }, {"void: /materials"});
}

TEST(MaterialBalls, FillABodyAndKeepWhatItAbsorbs) {
  Scene scene;
  scene.materials.resize(2);
  scenes::Material& glass = scene.materials[0];
  glass.transmission = 1;
  glass.thickness = 0.02f;
  glass.attenuationDistance = 0.05f;
  glass.attenuationColor = glm::vec3(0.2f, 0.5f, 0.9f);
  const glm::vec3 absorbed = glass.absorption() * glass.thickness;
  scene = scenes::makeMaterialBalls(std::move(scene));
  EXPECT_FLOAT_EQ(scene.materials[0].thickness, 0.92f);
  const glm::vec3 along = scene.materials[0].absorption() * 0.92f;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(along[c], absorbed[c], 1e-5f);
  EXPECT_EQ(scene.materials[1].thickness, 0.f) << "it is no body";
}

TEST(MaterialBalls, KeepTheSunAndLeaveLocalLights) {
  Scene scene;
  scene.materials.resize(300);
  scene.lights.resize(3);
  scene.lights[1].kind = scenes::LightKind::directional;
  scene = scenes::makeMaterialBalls(std::move(scene));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, scenes::LightKind::directional);
  EXPECT_TRUE(hasWarning(scene.warnings, "2 point and spot lights"));
  EXPECT_LT(scene.triangleCount(), std::size_t{1} << 23) << "many balls are coarser";
}

TEST(SceneInfo, CountsAndFlags) {
  const TempFolder folder;
  GltfFile file = makeFive();
  file.json["asset"]["generator"] = "a modeller";
  file.json["nodes"].push_back({{"mesh", 0}, {"translation", {2, 0, 0}}});
  file.json["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = scenes::loadScene(writeGlb(folder, file));
  const scenes::SceneInfo info = scenes::describeScene(scene);
  EXPECT_EQ(scene.facts.generator, "a modeller");
  EXPECT_EQ(info.triangles, 4u);
  EXPECT_EQ(info.vertices, 4u);
  EXPECT_EQ(info.instances, 2u);
  EXPECT_EQ(info.bounds.upper, glm::vec3(3, 1, 0));
  EXPECT_EQ(info.meshBytes, 4 * (12 + 12 + 8) + 6 * 4u);
  EXPECT_EQ(info.images, 0u) << "nothing shown reads it";
  using Flags = std::vector<std::string>;
  EXPECT_EQ(info.materials[0].triangles, 4u);
  EXPECT_EQ(info.materials[2].flags, (Flags{"alpha blend", "double-sided", "not shown"}));
  EXPECT_EQ(info.materials[3].flags, (Flags{"nonmetal", "emissive", "not shown"}));
  EXPECT_EQ(info.materials[4].flags, (Flags{"textured", "normal map", "not shown"}));
  EXPECT_EQ(info.materials[4].textures, Flags{"normal: n"});
}

} // namespace
} // namespace parity::tests
