// Resolved materials against materials whose every value is known.
#include "support/device.h"
#include "support/small_scenes.h"

#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/surface/material_pass.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t kMaterialSide = 8;

class MaterialPassTest : public tests::DeviceTest {
protected:
  std::vector<ResolvedMaterial> resolve(const scenes::Scene& scene) {
    const SceneBuffers buffers(device(), scene);
    const SurfacePass surfaces(device(), buffers, kMaterialSide, kMaterialSide);
    const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
    const std::vector<Surface> layers = surfaces.render(camera, {0, kMaterialSide}, glm::vec2(0.5f));
    const Surface& surface = layers.back();
    EXPECT_EQ(surface.size(), std::size_t{kMaterialSide} * kMaterialSide);
    return MaterialPass(device(), buffers, surfaces.binKinds(), surface.size()).resolve(surface, camera);
  }
};

void expectNear(const glm::vec3& actual, const glm::vec3& expected, float tolerance, const char* what) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance) << what << ", channel " << c;
}

int addTexel(scenes::Scene& scene, std::array<std::uint8_t, 4> rgba) {
  scenes::TextureImage& image = scene.images.emplace_back();
  image.name = "texel";
  image.pixels = base::Image8(1, 1, 4);
  std::copy(rgba.begin(), rgba.end(), image.pixels.pixels.begin());
  return static_cast<int>(scene.images.size()) - 1;
}

TEST_F(MaterialPassTest, FactorsComeBackAsTheMaterialHasThem) {
  scenes::Scene scene = tests::makeQuadScene();
  scenes::Material& material = scene.materials[0];
  material.baseColor = glm::vec4(0.8f, 0.5f, 0.2f, 1);
  material.metallic = 0.3f;
  material.roughness = 0.7f;
  material.emissive = glm::vec3(1.5f, 0, 0.25f);
  material.specular = 0.5f;
  material.specularColor = glm::vec3(1, 0.5f, 0.25f);
  material.ior = 2; // F0 = (1/3)^2
  const auto resolved = resolve(scene);
  for (std::size_t i = 0; i < resolved.size(); ++i) {
    const ResolvedMaterial& m = resolved[i];
    expectNear(m.baseColor, {0.8f, 0.5f, 0.2f}, 1e-6f, "base colour");
    expectNear(m.emissive, {1.5f, 0, 0.25f}, 1e-6f, "emissive");
    expectNear(m.F0, glm::vec3(1, 0.5f, 0.25f) * (0.5f / 9), 1e-6f, "F0");
    expectNear(m.normal, {0, 0, 1}, 1e-6f, "normal");
    expectNear(m.geometricNormal, {0, 0, 1}, 1e-6f, "geometric normal");
    expectNear(m.view, {0, 0, 1}, 1e-6f, "view of an orthographic camera");
    EXPECT_NEAR(m.position.z, 0, 1e-6f);
    EXPECT_LT(std::max(std::abs(m.position.x), std::abs(m.position.y)), 1);
    EXPECT_NEAR(m.F90, 0.5f, 1e-6f);
    EXPECT_EQ(m.metallic, 0.3f);
    EXPECT_EQ(m.roughness, 0.7f);
    EXPECT_EQ(m.occlusion, 1);
    EXPECT_EQ(m.opacity, 1);
    EXPECT_FALSE(m.unlit);
  }
}

// Each texture multiplies its factor: sRGB 188 is 0.5029 linear (IEC 61966-2-1), data is code / 255.
TEST_F(MaterialPassTest, TexturesMultiplyTheirFactorsAndTurnTheNormal) {
  scenes::Scene scene = tests::makeQuadScene();
  const int color = addTexel(scene, {188, 255, 0, 255}), data = addTexel(scene, {102, 51, 204, 255});
  const int normal = addTexel(scene, {204, 128, 230, 255}); // (0.6, 0, 0.8) within 0.3 degrees
  scenes::Material& material = scene.materials[0];
  material.baseColor = glm::vec4(1, 0.5f, 1, 1);
  material.emissive = glm::vec3(2);
  material.occlusionStrength = 0.5f;
  material.metallic = 0.5f;
  material.baseColorTexture.image = material.emissiveTexture.image = color;
  material.metallicRoughnessTexture.image = material.occlusionTexture.image = data;
  material.normalTexture.image = normal;
  const ResolvedMaterial m = resolve(scene).front();
  expectNear(m.baseColor, {0.5029f, 0.5f, 0}, 1e-3f, "base colour");
  expectNear(m.emissive, {1.0058f, 2, 0}, 2e-3f, "emissive");
  EXPECT_NEAR(m.roughness, 51 / 255.f, 1e-5f);
  EXPECT_NEAR(m.metallic, 0.5f * 204 / 255, 1e-5f);
  EXPECT_NEAR(m.occlusion, 1 + 0.5f * (102 / 255.f - 1), 1e-5f);
  expectNear(m.normal, {0.6f, 0, 0.8f}, 0.006f, "mapped normal");
  EXPECT_NEAR(glm::length(m.normal), 1, 1e-5f);
}

// One shader serves both materials of a scene: what one of them lacks, and where it reads, is asked at run time.
TEST_F(MaterialPassTest, MaterialsOfOneShaderReadTheirOwnTexturesAtTheirOwnUvs) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.meshes.push_back(tests::makeQuad(1));
  scene.meshes[1].uv1 = {{1, 0}, {0, 0}, {0, 1}, {1, 1}}; // uv0 mirrored
  scene.materials.push_back(scene.materials[0]);
  scene.instances = {{0, glm::scale(tests::translation(-0.5f, 0, 0), {0.5f, 1, 1}), "left"},
                     {1, glm::scale(tests::translation(0.5f, 0, 0), {0.5f, 1, 1}), "right"}};
  scenes::TextureImage& image = scene.images.emplace_back();
  image.pixels = base::Image8(2, 1, 4); // black, white
  std::fill(image.pixels.pixels.begin() + 4, image.pixels.pixels.end(), std::uint8_t{255});
  scene.materials[0].normalTexture.image = addTexel(scene, {204, 128, 230, 255}); // (0.6, 0, 0.8)
  const std::array<float, 4> plain = {0.25f, 0.25f, 0.75f, 0.75f}, swapped = {0.75f, 0.75f, 0.25f, 0.25f},
                             none = {1, 1, 1, 1};
  scenes::TextureSlot texture, shifted, second;
  texture.image = shifted.image = second.image = 0;
  shifted.uvTransform = {1, 0, 0.5f, 0, 1, 0};
  second.texCoord = 1;
  const auto expectColumns = [&](const scenes::TextureSlot& left, const std::array<float, 4>& ofLeft,
                                 const scenes::TextureSlot& right, const std::array<float, 4>& ofRight) {
    scene.materials[0].baseColorTexture = left;
    scene.materials[1].baseColorTexture = right;
    for (const ResolvedMaterial& m : resolve(scene)) {
      const auto column = static_cast<std::size_t>((m.position.x + 1) * kMaterialSide / 2);
      EXPECT_NEAR(m.baseColor.x, column < 4 ? ofLeft[column] : ofRight[column - 4], 1e-2f) << "column " << column;
      EXPECT_NEAR(m.normal.z, column < 4 ? 0.8f : 1, 1e-2f) << "a map of the left alone, column " << column;
    }
  };
  expectColumns(texture, plain, texture, plain);
  expectColumns(texture, plain, {}, none);
  expectColumns(texture, plain, shifted, swapped);
  expectColumns(shifted, swapped, texture, plain);
  expectColumns(texture, plain, second, swapped);
  expectColumns(shifted, swapped, {}, none);
  scene.meshes[1].uv1.assign(4, {0.75f, 0.5f}); // the white texel, not minified, where uv0 would be
  for (glm::vec2& uv : scene.meshes[1].uv0) uv *= 64;
  expectColumns(texture, plain, second, none);
  scene.meshes[1].uv0 = scene.meshes[0].uv0;
  scene.materials[1].unlit = true; // of another class
  expectColumns(texture, plain, shifted, swapped);
  expectColumns(shifted, swapped, texture, plain);
}

// Of one image, occlusion and metallic-roughness are one texel; what reads another, or reads it otherwise, has its own.
TEST_F(MaterialPassTest, OcclusionIsReadWhereItsSlotSays) {
  scenes::Scene scene = tests::makeQuadScene();
  const int both = addTexel(scene, {51, 102, 204, 255}), apart = addTexel(scene, {153, 0, 0, 255});
  scenes::Material& material = scene.materials[0];
  const auto occlusion = [&] { return resolve(scene).front().occlusion; };
  material.metallicRoughnessTexture.image = material.occlusionTexture.image = both;
  EXPECT_NEAR(occlusion(), 0.2f, 1e-5f);
  material.occlusionTexture.image = apart;
  EXPECT_NEAR(occlusion(), 0.6f, 1e-5f);
  material.metallicRoughnessTexture.image = -1;
  EXPECT_NEAR(occlusion(), 0.6f, 1e-5f);
  const auto isApart = [&] { return (classify(material).textures & kOcclusionApart) != 0; };
  EXPECT_TRUE(isApart());
  material.metallicRoughnessTexture = material.occlusionTexture;
  EXPECT_FALSE(isApart());
  material.occlusionTexture.uvTransform[2] = 0.5f;
  EXPECT_TRUE(isApart());
  material.occlusionTexture = material.metallicRoughnessTexture;
  material.occlusionTexture.sampler.wrapU = scenes::Wrap::clampToEdge;
  EXPECT_TRUE(isApart());
  material.occlusionTexture = {};
  EXPECT_FALSE(isApart()) << "there is none";
  // Two materials of one shader.
  scene.materials[0].metallicRoughnessTexture.image = scene.materials[0].occlusionTexture.image = both;
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].occlusionTexture.image = apart;
  scene.meshes.push_back(tests::makeQuad(1));
  scene.instances = {{0, glm::scale(tests::translation(-0.5f, 0, 0), {0.5f, 1, 1}), "left"},
                     {1, glm::scale(tests::translation(0.5f, 0, 0), {0.5f, 1, 1}), "right"}};
  for (const ResolvedMaterial& m : resolve(scene)) EXPECT_NEAR(m.occlusion, m.position.x < 0 ? 0.2f : 0.6f, 1e-5f);
}

// Materials that differ in that alone are of one class.
TEST_F(MaterialPassTest, ATransformOfUvsMakesNoClassOfItsOwn) {
  scenes::Scene scene = tests::makeQuadScene();
  addTexel(scene, {1, 2, 3, 255});
  scene.materials[0].baseColorTexture.image = 0;
  scene.materials.resize(4, scene.materials[0]);
  const MaterialClass plain = classify(scene.materials[0]);
  scene.materials[1].baseColorTexture.uvTransform[2] = 0.5f;
  scene.materials[2].unlit = true;
  scene.materials[3].baseColorTexture.image = -1;
  scene.materials[3].baseColorTexture.uvTransform[2] = 0.5f; // of no texture
  const SceneBuffers buffers(device(), scene);
  const MaterialClass transformed{plain.textures | kTransformedUvs, plain.features};
  EXPECT_EQ(classify(scene.materials[1]), transformed);
  EXPECT_EQ(buffers.classOfMaterial(),
            (std::vector{transformed, transformed, classify(scene.materials[2]), MaterialClass{0, plain.features}}));
}

// A scene without them has none, whatever the memory held before.
TEST_F(MaterialPassTest, LobesComeBackWhereTheSceneHasThem) {
  scenes::Scene plain = tests::makeQuadScene(), layered = plain;
  scenes::Material& material = layered.materials[0];
  material.coat = 0.75f, material.coatRoughness = 0.25f;
  material.sheenColor = glm::vec3(1, 0.5f, 0.25f), material.sheenRoughness = 0.5f;
  material.anisotropy = 0.6f, material.anisotropyRotation = 0.5f;
  material.iridescence = 0.4f, material.iridescenceIor = 1.7f, material.iridescenceThicknessMax = 350;
  for (const ResolvedMaterial& m : resolve(layered)) {
    EXPECT_EQ(m.coat, 0.75f);
    EXPECT_EQ(m.coatRoughness, 0.25f);
    EXPECT_EQ(m.coatNormal, m.normal);
    EXPECT_EQ(m.sheenColor, glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(m.sheenRoughness, 0.5f);
    EXPECT_EQ(m.anisotropy, 0.6f);
    EXPECT_NEAR(glm::dot(m.tangent, m.normal), 0, 1e-6f);
    EXPECT_NEAR(glm::length(m.tangent), 1, 1e-6f);
    EXPECT_EQ(m.iridescence, 0.4f);
    EXPECT_EQ(m.filmIor, 1.7f);
    EXPECT_EQ(m.filmThickness, 350);
  }
  for (const ResolvedMaterial& m : resolve(plain)) {
    EXPECT_EQ(m.coat, 0);
    EXPECT_EQ(m.sheenColor, glm::vec3(0));
    EXPECT_EQ(m.anisotropy, 0);
    EXPECT_EQ(m.iridescence, 0);
  }
}

// The direction: the mesh's tangent, turned counter-clockwise towards the bitangent, in the plane of the shading
// normal.
TEST_F(MaterialPassTest, AnisotropyFollowsTheTangent) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.materials[0].anisotropy = 1;
  scene.materials[0].anisotropyRotation = std::numbers::pi_v<float> / 2;
  scene.meshes[0].normals.assign(4, glm::vec3(0.6f, 0, 0.8f));
  for (const float sign : {1.f, -1.f}) {
    scene.meshes[0].tangents.assign(4, glm::vec4(0.8f, 0, -0.6f, sign));
    for (const ResolvedMaterial& m : resolve(scene)) expectNear(m.tangent, {0, sign, 0}, 1e-3f, "bitangent");
  }
  scene.materials[0].anisotropyRotation = 0;
  scene.meshes[0].tangents.assign(4, glm::vec4(1, 0, 0, 1)); // not at right angles to the normal
  for (const ResolvedMaterial& m : resolve(scene)) expectNear(m.tangent, {0.8f, 0, -0.6f}, 1e-3f, "in the plane");
}

// Shading normals lean, the surface does not; a back face shows its other side.
TEST_F(MaterialPassTest, GeometricNormalIsTheTrianglesOnTheSideOfTheEye) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.meshes[0].normals.assign(4, glm::normalize(glm::vec3(0.6f, 0, 0.8f)));
  const glm::vec3 axis = glm::normalize(glm::vec3(0, 1, 0));
  for (const float degrees : {35.f, 145.f}) {
    scene.instances[0].toWorld =
        glm::rotate(glm::scale(glm::mat4(1.f), glm::vec3(1.5f)), glm::radians(degrees), axis); // fills the picture
    const float a = glm::radians(degrees), side = degrees < 90 ? 1.f : -1.f;
    expectNear(resolve(scene).front().geometricNormal, side * glm::vec3(std::sin(a), 0, std::cos(a)), 1e-4f, "tilted");
  }
}

TEST_F(MaterialPassTest, UnlitAndOpacityAreTold) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.materials[0].unlit = true;
  scene.materials[0].alphaMode = scenes::AlphaMode::blend;
  scene.materials[0].baseColor = glm::vec4(0.1f, 0.2f, 0.3f, 0.25f);
  const ResolvedMaterial m = resolve(scene).front();
  EXPECT_TRUE(m.unlit);
  EXPECT_EQ(m.opacity, 0.25f);
  expectNear(m.baseColor, {0.1f, 0.2f, 0.3f}, 1e-6f, "base colour");
}

} // namespace
} // namespace parity::gpu
