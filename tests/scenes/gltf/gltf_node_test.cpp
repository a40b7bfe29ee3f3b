// The node hierarchy, lights and cameras.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::LightKind;
using scenes::Scene;

glm::vec3 origin(const Scene& scene, std::size_t instance) {
  return glm::vec3(scene.instances.at(instance).toWorld[3]);
}

TEST(GltfNodes, MultipliesTransformsDownTheHierarchy) {
  GltfFile file = makeQuad();
  const float h = std::sqrt(0.5f);
  file.json["nodes"] = {{{"name", "root"}, {"translation", {1, 2, 3}}, {"rotation", {0, h, 0, h}}, {"children", {1}}},
                        {{"name", "arm"}, {"scale", {2, 3, 4}}, {"children", {2}}},
                        {{"translation", {0, 0, 1}}, {"mesh", 0}}};
  const Scene scene = loadQuadlike(file);
  // 90 degrees about +Y takes +Z to +X; the scale of 4 along z comes before it.
  EXPECT_NEAR(glm::length(origin(scene, 0) - glm::vec3(5, 2, 3)), 0.f, 1e-5f);
  EXPECT_EQ(scene.instances[0].node, "root/arm/node 2");
  const glm::vec3 corner = glm::vec3(scene.instances[0].toWorld * glm::vec4(1, 1, 0, 1));
  EXPECT_NEAR(glm::length(corner - glm::vec3(5, 5, 1)), 0.f, 1e-5f);
}

TEST(GltfNodes, ReadsMatricesByColumns) {
  GltfFile file = makeQuad();
  file.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
  EXPECT_EQ(origin(loadQuadlike(file), 0), glm::vec3(7, 8, 9));
}

TEST(GltfNodes, ShowsTheDefaultSceneElseTheFirstElseAllRoots) {
  GltfFile file = makeQuad();
  file.json["nodes"] = {{{"mesh", 0}, {"translation", {0, 0, 0}}}, {{"mesh", 0}, {"translation", {5, 0, 0}}}};
  file.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  file.json["scene"] = 1;
  Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(origin(scene, 0).x, 5.f);
  EXPECT_TRUE(hasWarning(scene.warnings, "the file has 2 scenes, scene 1 is shown"));
  file.json.erase("scene");
  scene = loadQuadlike(file);
  EXPECT_EQ(origin(scene, 0).x, 0.f);
  file.json.erase("scenes");
  scene = loadQuadlike(file);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_TRUE(hasWarning(scene.warnings, "no scene"));
}

TEST(GltfNodes, SharesAMeshBetweenInstancesAndCountsItsTriangles) {
  GltfFile file = makeQuad();
  file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"scale", {-1, 1, 1}}}};
  file.json["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.triangleCount(), 4u);
  EXPECT_LT(glm::determinant(glm::mat3(scene.instances[1].toWorld)), 0.f) << "mirrored";
  EXPECT_EQ(scene.bounds().lower, glm::vec3(-1, 0, 0));
  EXPECT_EQ(scene.bounds().upper, glm::vec3(1, 1, 0));
}

TEST(GltfNodes, LeavesOutWhatIsScaledToNothing) {
  GltfFile file = makeQuad();
  file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"scale", {0, 0, 1}}}};
  file.json["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(hasWarning(scene.warnings, "a scale of 0"));
}

GltfFile makeLit(const json& light, const json& node) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"KHR_lights_punctual"};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  json placed = node;
  placed["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.json["nodes"].push_back(placed);
  file.json["scenes"][0]["nodes"].push_back(1);
  return file;
}

TEST(GltfLights, ReadsAllKindsWithTheirNodesTransform) {
  const float h = std::sqrt(0.5f);
  Scene scene = loadQuadlike(makeLit({{"type", "directional"}, {"color", {1, 0.5, 0.25}}, {"intensity", 4}},
                                     {{"rotation", {-h, 0, 0, h}}, {"scale", {3, 3, 3}}}));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::directional);
  EXPECT_EQ(scene.lights[0].color, glm::vec3(4, 2, 1));
  // -90 degrees about +X turns -Z to -Y: straight down.
  EXPECT_NEAR(glm::length(scene.lights[0].direction - glm::vec3(0, -1, 0)), 0.f, 1e-6f);

  scene = loadQuadlike(makeLit({{"type", "point"}, {"range", 7}, {"name", "bulb"}}, {{"translation", {1, 2, 3}}}));
  EXPECT_EQ(scene.lights[0].kind, LightKind::point);
  EXPECT_EQ(scene.lights[0].position, glm::vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].range, 7.f);
  EXPECT_EQ(scene.lights[0].name, "bulb");
  EXPECT_EQ(scene.lights[0].color, glm::vec3(1));

  scene = loadQuadlike(
      makeLit({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.6}}}}, json::object()));
  EXPECT_EQ(scene.lights[0].kind, LightKind::spot);
  EXPECT_EQ(scene.lights[0].direction, glm::vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(scene.lights[0].innerConeAngle, 0.2f);
  EXPECT_FLOAT_EQ(scene.lights[0].outerConeAngle, 0.6f);
  EXPECT_EQ(scene.lights[0].range, 0.f) << "infinite";
  scene = loadQuadlike(makeLit({{"type", "spot"}, {"spot", json::object()}}, json::object()));
  EXPECT_FLOAT_EQ(scene.lights[0].outerConeAngle, glm::quarter_pi<float>());
}

TEST(GltfLights, ReadsTheFalloffExponentOfTheExtras) {
  Scene scene =
      loadQuadlike(makeLit({{"type", "point"}, {"range", 7}, {"extras", {{"falloffExponent", 8}}}}, json::object()));
  EXPECT_EQ(scene.lights[0].falloff, scenes::Falloff::exponent);
  EXPECT_EQ(scene.lights[0].falloffExponent, 8.f);
  scene = loadQuadlike(makeLit(
      {{"type", "spot"}, {"range", 2}, {"spot", json::object()}, {"extras", {{"falloffExponent", 0.5}, {"note", "x"}}}},
      json::object()));
  EXPECT_EQ(scene.lights[0].falloffExponent, 0.5f);
  scene = loadQuadlike(makeLit({{"type", "point"}, {"range", 7}, {"extras", {{"note", "x"}}}}, json::object()));
  EXPECT_EQ(scene.lights[0].falloff, scenes::Falloff::khr) << "the inverse square";
  scene = loadQuadlike(makeLit({{"type", "directional"}, {"extras", {{"falloffExponent", 8}}}}, json::object()));
  EXPECT_EQ(scene.lights[0].falloff, scenes::Falloff::khr);
  EXPECT_TRUE(hasWarning(scene.warnings, "/lights/0/extras/falloffExponent: ignored, a directional light"));
}

TEST(GltfLights, RefusesWhatIsNoFalloffExponent) {
  const TempFolder folder;
  for (const json& exponent : {json(0), json(-2), json(1001), json("8"), json(true), json::array({8})})
    expectError(
        [&] {
          scenes::loadScene(writeExternal(
              folder,
              makeLit({{"type", "point"}, {"range", 7}, {"extras", {{"falloffExponent", exponent}}}}, json::object())));
        },
        {"/extensions/KHR_lights_punctual/lights/0/extras/falloffExponent: is not a number above 0, up to 1000"});
  expectError(
      [&] {
        scenes::loadScene(
            writeExternal(folder, makeLit({{"type", "point"}, {"extras", {{"falloffExponent", 8}}}}, json::object())));
      },
      {"/extensions/KHR_lights_punctual/lights/0/extras/falloffExponent: needs a finite range"});
}

TEST(GltfLights, RefusesWhatHasNoMeaning) {
  const TempFolder folder;
  const auto load = [&](const json& light, const json& node = json::object()) {
    scenes::loadScene(writeExternal(folder, makeLit(light, node)));
  };
  expectError(
      [&] {
        load({{"type", "area"}});
      },
      {"/lights/0/type: is \"area\", expected one of directional, point, spot"});
  expectError([&] { load({{"type", "point"}, {"intensity", -1}}); }, {"/lights/0/intensity", "negative"});
  expectError(
      [&] {
        load({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}}});
      },
      {"/lights/0/spot", "inner < outer"});
  expectError([&] { load({{"type", "spot"}}); }, {"/extensions/KHR_lights_punctual/lights/0/spot: is missing"});
}

TEST(GltfCameras, ReadsPerspectiveAndOrthographicOnesWithoutTheirNodesScale) {
  GltfFile file = makeQuad();
  file.json["cameras"] = {
      {{"type", "perspective"}, {"name", "eye"}, {"perspective", {{"yfov", glm::half_pi<double>()}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 50}}}}};
  file.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 4}}, {"scale", {-2, 2, 2}}});
  file.json["nodes"].push_back({{"camera", 1}, {"name", "plan"}});
  file.json["nodes"].push_back({{"camera", 0}});
  file.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.cameras.size(), 3u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_FLOAT_EQ(scene.cameras[0].fovYDeg, 90.f);
  EXPECT_EQ(scene.cameras[0].zFar, 0.f) << "infinite in the file";
  const glm::mat3 axes(scene.cameras[0].toWorld);
  EXPECT_NEAR(glm::determinant(axes), 1.f, 1e-6f) << "a rotation, though the node mirrors";
  EXPECT_NEAR(glm::length(axes[2] - glm::vec3(0, 0, 1)), 0.f, 1e-6f);
  EXPECT_TRUE(scene.cameras[1].orthographic);
  EXPECT_EQ(scene.cameras[1].halfHeight, 3.f);
  EXPECT_EQ(scene.cameras[1].name, "plan") << "the node's, where the camera has none";
  EXPECT_EQ(scene.cameras[2].name, "eye (2)");
}

} // namespace
} // namespace parity::tests
