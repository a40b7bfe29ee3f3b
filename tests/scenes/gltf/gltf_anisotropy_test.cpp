// Which tangents give the anisotropy of KHR_materials_anisotropy its direction.
#include <cmath>

#include "scenes/builtin/material_balls.h"
#include "scenes/gltf/lobed_quad.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using scenes::Scene;

// u of TEXCOORD_0 runs along x, that of TEXCOORD_1 along y.
constexpr int kX = 0, kY = 1;

void expectTangentsAlong(const Scene& scene, int axis) {
  const scenes::Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  for (const glm::vec4& tangent : mesh.tangents) EXPECT_NEAR(std::abs(tangent[axis]), 1, 1e-6);
}

TEST(GltfAnisotropy, WithoutTexturesFollowsTheFirstUvSet) {
  Scene scene = loadWithExtensions(anisotropyOf({{"anisotropyStrength", 0.5}}));
  expectTangentsAlong(scene, kX);
  EXPECT_TRUE(scene.warnings.empty());
  const Scene balls = scenes::makeMaterialBalls(scene);
  EXPECT_EQ(balls.meshes[0].tangents.size(), balls.meshes[0].positions.size());
  GltfFile file = makeLobed(); // whose colour reads the other set
  file.material() = {{"pbrMetallicRoughness", {{"baseColorTexture", textured(0, 1)}}},
                     {"extensions", anisotropyOf({{"anisotropyStrength", 0.5}})}};
  expectTangentsAlong(loadQuadlike(file), kX);
  file.primitive()["attributes"]["TEXCOORD_2"] = file.primitive()["attributes"]["TEXCOORD_1"];
  file.material()["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2;
  scene = loadQuadlike(file);
  expectTangentsAlong(scene, kX);
  EXPECT_EQ(scene.materials[0].baseColorTexture.texCoord, 1) << "TEXCOORD_2 is the second of the two that are kept";
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfAnisotropy, SaysWhereItsTangentsCannotFollowTheFirstUvSet) {
  GltfFile file = makeLobed();
  file.primitive()["attributes"]["TEXCOORD_2"] = file.primitive()["attributes"]["TEXCOORD_0"];
  file.material() = {
      {"pbrMetallicRoughness", {{"baseColorTexture", textured(0, 1)}, {"metallicRoughnessTexture", textured(1, 2)}}},
      {"extensions", anisotropyOf({{"anisotropyStrength", 0.5}})}};
  const Scene scene = loadQuadlike(file);
  expectTangentsAlong(scene, kY);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0],
            "/materials/0: the textures use TEXCOORD_1 and TEXCOORD_2, and more than two sets are not supported; the "
            "tangents follow TEXCOORD_1 instead of TEXCOORD_0, so the anisotropy may be turned");
}

TEST(GltfAnisotropy, FollowsItsTextureUnlessANormalMapIsThere) {
  GltfFile file = makeLobed();
  file.material()["extensions"] = anisotropyOf({{"anisotropyStrength", 0.5}, {"anisotropyTexture", textured(0, 1)}});
  Scene scene = loadQuadlike(file);
  expectTangentsAlong(scene, kY);
  EXPECT_TRUE(scene.warnings.empty());

  file.material()["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1},
                                                              {"clearcoatNormalTexture", textured(1, 0)}};
  scene = loadQuadlike(file);
  expectTangentsAlong(scene, kX);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0],
            "/materials/0: the anisotropyTexture uses TEXCOORD_1, the normal map of the coat TEXCOORD_0; both take "
            "their tangents from the normal map's, so the anisotropy may be turned");

  file.material()["normalTexture"] = textured(2, 0);
  scene = loadQuadlike(file);
  expectTangentsAlong(scene, kX);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0],
            "/materials/0: the anisotropyTexture uses TEXCOORD_1, the normal map TEXCOORD_0; both take their tangents "
            "from the normal map's, so the anisotropy may be turned");

  file.material()["normalTexture"] = textured(2, 1);
  file.material()["extensions"].erase("KHR_materials_clearcoat");
  scene = loadQuadlike(file);
  expectTangentsAlong(scene, kY);
  EXPECT_TRUE(scene.warnings.empty()) << "the same set";
}

TEST(GltfAnisotropy, TakesTheTangentsOfTheFile) {
  GltfFile file = makeLobed();
  file.primitive()["attributes"]["TANGENT"] =
      file.add<float>({0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1}, "VEC4");
  file.material()["extensions"] = anisotropyOf({{"anisotropyStrength", 0.5}});
  EXPECT_EQ(loadQuadlike(file).meshes[0].tangents.at(0), glm::vec4(0.6f, 0.8f, 0, -1));
  file.primitive()["attributes"].erase("TEXCOORD_0"); // not needed then
  file.primitive()["attributes"].erase("TEXCOORD_1");
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.meshes[0].tangents.at(0), glm::vec4(0.6f, 0.8f, 0, -1));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfAnisotropy, WithoutTangentsAndUvsIsToldInOneLineThatItsDirectionIsArbitrary) {
  GltfFile file = makeLobed();
  file.primitive()["attributes"].erase("TEXCOORD_0");
  file.primitive()["attributes"].erase("TEXCOORD_1");
  file.material()["extensions"] = anisotropyOf({{"anisotropyStrength", 0.5}});
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "/meshes/0/primitives/0: has neither tangents nor TEXCOORD_0, so the direction of the "
                               "anisotropy of material 'paint' is arbitrary");
  const scenes::Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    EXPECT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1, 1e-6);
    EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0, 1e-6);
  }
}

} // namespace
} // namespace parity::tests
