// Morph targets and skins against poses in closed form.
#include <cmath>

#include "scenes/gltf/expect_refused.h"
#include "scenes/gltf/gltf_writer.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Scene;

// A quad with two targets: one moves it by (0,0,1), the other corner 2 by (2,0,0) and tilts its normals by (1,0,0).
GltfFile makeMorphed() {
  GltfFile file = makeQuad();
  const int up = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int corner = file.add<float>({0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0}, "VEC3");
  const int tilt = file.add<float>({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
  file.primitive()["targets"] = {{{"POSITION", up}}, {{"POSITION", corner}, {"NORMAL", tilt}}};
  return file;
}

TEST(GltfMorph, TakesTheWeightsOfTheNodeOverThoseOfTheMesh) {
  GltfFile file = makeMorphed();
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions[2], glm::vec3(1, 1, 0)) << "none: as it is stored";
  file.json["meshes"][0]["weights"] = {0.25, 0};
  EXPECT_EQ(loadQuadlike(file).meshes[0].positions[2], glm::vec3(1, 1, 0.25));
  file.json["nodes"][0]["weights"] = {0.5, 1};
  const scenes::Mesh mesh = loadQuadlike(file).meshes[0];
  EXPECT_EQ(mesh.positions[2], glm::vec3(3, 1, 0.5));
  EXPECT_EQ(mesh.positions[0], glm::vec3(0, 0, 0.5));
  EXPECT_NEAR(glm::length(mesh.normals[1] - glm::normalize(glm::vec3(1, 0, 1))), 0.f, 1e-6f);
}

TEST(GltfMorph, MovesUvColoursAndTangentsToo) {
  GltfFile file = makeQuad();
  const auto spread = [](const std::vector<float>& one) {
    std::vector<float> all;
    for (int i = 0; i < 4; ++i) all.insert(all.end(), one.begin(), one.end());
    return all;
  };
  file.primitive()["attributes"]["COLOR_0"] = file.add<float>(spread({0.5f, 0.5f, 0.5f, 1}), "VEC4");
  file.primitive()["attributes"]["TANGENT"] = file.add<float>(spread({1, 0, 0, -1}), "VEC4");
  file.primitive()["targets"] = {{{"COLOR_0", file.add<float>(spread({0.5f, -2, 0, 0}), "VEC4")},
                                  {"TANGENT", file.add<float>(spread({-1, 1, 0}), "VEC3")},
                                  {"TEXCOORD_0", file.add<float>(spread({0, 4}), "VEC2")}}};
  file.json["meshes"][0]["weights"] = {0.5};
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(2, 2))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  const scenes::Mesh mesh = loadQuadlike(file).meshes[0];
  EXPECT_EQ(mesh.colors[3], glm::vec4(0.75f, 0, 0.5f, 1)) << "clamped";
  EXPECT_EQ(mesh.uv0[0], glm::vec2(0, 3));
  EXPECT_NEAR(glm::length(mesh.tangents[0] - glm::vec4(std::sqrt(0.5f), std::sqrt(0.5f), 0, -1)), 0.f, 1e-6f);
}

TEST(GltfMorph, GivesNodesOfDifferentWeightsMeshesOfTheirOwnAndSharesEqualOnes) {
  GltfFile file = makeMorphed();
  file.json["nodes"] = {{{"mesh", 0}, {"weights", {1, 0}}}, {{"mesh", 0}}, {{"mesh", 0}, {"weights", {1, 0}}}};
  file.json["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.meshes.size(), 2u);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
  EXPECT_EQ(scene.meshes[scene.instances[0].mesh].positions[0].z, 1.f);
  EXPECT_EQ(scene.meshes[scene.instances[1].mesh].positions[0].z, 0.f);
}

TEST(GltfMorph, MakesFlatNormalsOfTheMovedTriangles) {
  GltfFile file = makeMorphed();
  file.primitive()["attributes"].erase("NORMAL");
  // Corner 2 and 3 (y = 1) go up by 1: a slope of 45 degrees.
  file.primitive()["targets"] = {{{"POSITION", file.add<float>({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
  file.json["meshes"][0]["weights"] = {1};
  const scenes::Mesh posed = loadQuadlike(file).meshes[0];
  for (const glm::vec3& n : posed.normals)
    EXPECT_NEAR(glm::length(n - glm::normalize(glm::vec3(0, -1, 1))), 0.f, 1e-6f);
}

TEST(GltfMorph, RefusesCountsThatDoNotMatch) {
  GltfFile file = makeMorphed();
  file.json["nodes"][0]["weights"] = {1};
  expectRefused(file, {"/nodes/0/weights: holds 1 weights, expected 2, one for each target"});
  file = makeMorphed();
  file.json["meshes"][0]["weights"] = {1, 2, 3};
  expectRefused(file, {"/meshes/0/weights: holds 3 weights, expected 2"});
  file = makeMorphed();
  file.json["meshes"][0]["primitives"].push_back(file.primitive());
  file.json["meshes"][0]["primitives"][1].erase("targets");
  expectRefused(file, {"/meshes/0/primitives/1/targets: has 0 targets, expected 2"});
  file = makeMorphed();
  file.json["meshes"][0]["weights"] = {1, 0};
  file.primitive()["targets"][0]["POSITION"] = file.add<float>({0, 0, 1}, "VEC3");
  expectRefused(file, {"/meshes/0/primitives/0/targets/0/POSITION (/accessors/7): has 1 elements, but POSITION has 4"});
  file.primitive()["targets"][0]["POSITION"] = file.add<float>(std::vector<float>(12, std::nanf("")), "VEC3");
  expectRefused(file, {"targets/0/POSITION", "element 0 is not finite"});
}

// The quad hangs on two joints: nodes 1 at the origin and 2, which is 1's child. Corners 0 and 3 (x = 0) belong to the
// first, 1 and 2 (x = 1) to the second. The quad's own node is moved, to no effect.
GltfFile makeSkinned() {
  GltfFile file = makeQuad();
  file.primitive()["attributes"]["JOINTS_0"] =
      file.add<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
  file.primitive()["attributes"]["WEIGHTS_0"] =
      file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  file.json["skins"] = {{{"joints", {1, 2}}}};
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {50, 60, 70}}},
                        {{"name", "hip"}, {"children", {2}}},
                        {{"name", "knee"}}};
  file.json["scenes"][0]["nodes"] = {0, 1};
  return file;
}

// Binds joint 1 at x = 1: its inverse bind matrix moves that to the origin.
int addBindAtOne(GltfFile& file) {
  return file.add<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1, //
                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                         "MAT4");
}

TEST(GltfSkin, MovesVerticesWithTheirJointsAndNotWithTheirNode) {
  GltfFile file = makeSkinned();
  file.json["skins"][0]["inverseBindMatrices"] = addBindAtOne(file);
  const float h = std::sqrt(0.5f);
  file.json["nodes"][1]["translation"] = {0, 0, 5};
  file.json["nodes"][2]["translation"] = {1, 0, 0};
  file.json["nodes"][2]["rotation"] = {0, h, 0, h}; // +Z goes to +X, +X to -Z
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].toWorld, glm::mat4(1.f));
  const scenes::Mesh& mesh = scene.meshes[0];
  const std::vector<glm::vec3> expected = {{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
  for (std::size_t v = 0; v < 4; ++v) EXPECT_NEAR(glm::length(mesh.positions[v] - expected[v]), 0.f, 1e-6f) << v;
  EXPECT_NEAR(glm::length(mesh.normals[0] - glm::vec3(0, 0, 1)), 0.f, 1e-6f);
  EXPECT_NEAR(glm::length(mesh.normals[1] - glm::vec3(1, 0, 0)), 0.f, 1e-6f);
}

TEST(GltfSkin, IsNotMovedByInstancesAndSaysSo) {
  GltfFile file = makeSkinned();
  const int places = file.add<float>({1, 2, 3, 4, 5, 6}, "VEC3");
  file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places}};
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].toWorld, glm::mat4(1.f));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("/nodes/0"), std::string::npos);
  EXPECT_NE(scene.warnings[0].find("does not move a skinned mesh"), std::string::npos);
}

TEST(GltfSkin, BlendsMatricesByAllSetsOfWeights) {
  GltfFile file = makeSkinned();
  file.json["nodes"][2]["translation"] = {0, 0, 8};
  std::vector<std::uint8_t> second(16, 1);
  std::vector<float> quarter(16, 0), rest(16, 0);
  for (std::size_t i = 0; i < 16; i += 4) quarter[i] = 0.75f, rest[i] = 0.25f;
  auto& attributes = file.primitive()["attributes"];
  attributes["JOINTS_0"] = file.add<std::uint16_t>(std::vector<std::uint16_t>(16, 0), "VEC4");
  attributes["WEIGHTS_0"] = file.add<float>(quarter, "VEC4");
  attributes["JOINTS_1"] = file.add<std::uint8_t>(second, "VEC4");
  attributes["WEIGHTS_1"] = file.add<float>(rest, "VEC4");
  const scenes::Mesh posed = loadQuadlike(file).meshes[0];
  for (const glm::vec3& p : posed.positions) EXPECT_EQ(p.z, 2.f);
  std::vector<std::uint8_t> bytes(16, 0); // 191 and 64 of 255
  for (std::size_t i = 0; i < 16; i += 4) bytes[i] = 191;
  attributes["WEIGHTS_0"] = file.add<std::uint8_t>(bytes, "VEC4", true);
  for (std::size_t i = 0; i < 16; i += 4) bytes[i] = 64;
  attributes["WEIGHTS_1"] = file.add<std::uint8_t>(bytes, "VEC4", true);
  const Scene scene = loadQuadlike(file);
  for (const glm::vec3& p : scene.meshes[0].positions) EXPECT_NEAR(p.z, 8 * 64.f / 255, 1e-6f);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfSkin, TransformsNormalsByTheInverseTransposeAndTangentsAsDirections) {
  GltfFile file = makeSkinned();
  const float s = std::sqrt(0.5f);
  file.primitive()["attributes"]["NORMAL"] = file.add<float>({s, 0, s, s, 0, s, s, 0, s, s, 0, s}, "VEC3");
  file.primitive()["attributes"]["TANGENT"] =
      file.add<float>({s, 0, -s, 1, s, 0, -s, 1, s, 0, -s, 1, s, 0, -s, 1}, "VEC4");
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(2, 2))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  file.json["nodes"][1]["scale"] = {1, 1, 2};
  scenes::Mesh mesh = loadQuadlike(file).meshes[0];
  EXPECT_NEAR(glm::length(mesh.normals[0] - glm::normalize(glm::vec3(1, 0, 0.5f))), 0.f, 1e-6f);
  EXPECT_NEAR(glm::length(mesh.tangents[0] - glm::vec4(glm::normalize(glm::vec3(1, 0, -2)), 1)), 0.f, 1e-6f);
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  file.json["nodes"][1]["scale"] = {1, 1, -2}; // mirrored: the triangles turn round, the handedness changes
  mesh = loadQuadlike(file).meshes[0];
  EXPECT_NEAR(glm::length(mesh.normals[0] - glm::normalize(glm::vec3(1, 0, -0.5f))), 0.f, 1e-6f);
  EXPECT_NEAR(glm::length(mesh.tangents[0] - glm::vec4(glm::normalize(glm::vec3(1, 0, 2)), -1)), 0.f, 1e-6f);
  EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2}));
}

TEST(GltfSkin, FindsJointsOutsideTheScene) {
  GltfFile file = makeSkinned();
  file.json["nodes"][1]["translation"] = {3, 0, 0};
  file.json["scenes"][0]["nodes"] = {0};
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes[0].positions[0], glm::vec3(3, 0, 0));
  EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(GltfSkin, ScalesWeightsAndFollowsTheFirstJointWhereThereAreNone) {
  GltfFile file = makeSkinned();
  file.json["nodes"][2]["translation"] = {0, 0, 8};
  file.primitive()["attributes"]["WEIGHTS_0"] =
      file.add<float>({0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes[0].positions[0], glm::vec3(0, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(1, 0, 8));
  EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(1, 1, 8)) << "no weight: joint 1, its first";
  EXPECT_TRUE(hasWarning(scene.warnings, "the weights of 2 vertices do not sum to 1"));
  EXPECT_TRUE(hasWarning(scene.warnings, "1 vertices have no weight"));
}

TEST(GltfSkin, ShowsAMeshWithoutJointsWhereItsNodeStands) {
  GltfFile file = makeSkinned();
  file.primitive()["attributes"].erase("JOINTS_0");
  file.primitive()["attributes"].erase("WEIGHTS_0");
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(glm::vec3(scene.instances[0].toWorld[3]), glm::vec3(50, 60, 70));
  EXPECT_TRUE(hasWarning(scene.warnings, "has a skin but no JOINTS_0 and WEIGHTS_0"));
}

TEST(GltfSkin, RefusesWhatHasNoMeaning) {
  const auto refuse = [](const std::function<void(GltfFile&)>& edit, const std::vector<std::string>& parts) {
    GltfFile file = makeSkinned();
    edit(file);
    expectRefused(file, parts);
  };
  const auto attribute = [](GltfFile& f, const char* name) -> json& { return f.primitive()["attributes"][name]; };
  refuse(
      [&](GltfFile& f) {
        attribute(f, "JOINTS_0") = f.add<std::uint8_t>({0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
      },
      {"JOINTS_0 (/accessors/6): element 1 holds joint 2, expected one of the skin's 2"});
  refuse([&](GltfFile& f) { attribute(f, "JOINTS_0") = f.add<float>(std::vector<float>(16, 0), "VEC4"); },
         {"has the componentType 5126, which JOINTS_0 cannot have"});
  refuse([&](GltfFile& f) { attribute(f, "WEIGHTS_0") = f.add<float>(std::vector<float>(16, -1), "VEC4"); },
         {"WEIGHTS_0 (/accessors/6): element 0 holds -1, expected at least 0"});
  refuse([&](GltfFile& f) { attribute(f, "WEIGHTS_0") = f.add<float>(std::vector<float>(16, std::nanf("")), "VEC4"); },
         {"WEIGHTS_0", "element 0 is not finite"});
  refuse([](GltfFile& f) { f.primitive()["attributes"].erase("WEIGHTS_0"); },
         {"/meshes/0/primitives/0/attributes: has only one of JOINTS_0 and WEIGHTS_0, expected both"});
  refuse([](GltfFile& f) { f.json["skins"][0]["joints"] = json::array(); }, {"/skins/0/joints: is empty"});
  refuse(
      [](GltfFile& f) {
        f.json["skins"][0]["joints"] = {1, 9};
      },
      {"/skins/0/joints/1: is 9, expected an index of nodes"});
  refuse(
      [](GltfFile& f) {
        f.json["skins"][0]["inverseBindMatrices"] = addBindAtOne(f);
        f.json["skins"][0]["joints"] = {1, 2, 1};
      },
      {"/skins/0/inverseBindMatrices (/accessors/6): has 2 matrices, expected 3"});
  refuse(
      [](GltfFile& f) { f.json["skins"][0]["inverseBindMatrices"] = f.add<float>(std::vector<float>(32, 1), "MAT4"); },
      {"element 0 is not affine"});
  refuse([](GltfFile& f) { f.json["skins"][0]["inverseBindMatrices"] = 0; }, {"expected matrices MAT4 of FLOAT"});
}

TEST(GltfSkin, MakesTangentsOfThePosedMesh) {
  GltfFile file = makeSkinned();
  file.json["images"] = {{{"bufferView", file.addBufferView(makePng(2, 2))}, {"mimeType", "image/png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["normalTexture"] = {{"index", 0}};
  const float h = std::sqrt(0.5f);
  file.json["nodes"][1]["rotation"] = {0, 0, h, h}; // +X, the way of u, goes to +Y
  const scenes::Mesh posed = loadQuadlike(file).meshes[0];
  for (const glm::vec4& t : posed.tangents) EXPECT_NEAR(glm::length(t - glm::vec4(0, 1, 0, 1)), 0.f, 1e-6f);
}

} // namespace
} // namespace parity::tests
