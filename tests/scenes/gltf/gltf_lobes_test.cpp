// KHR_materials_clearcoat and KHR_materials_sheen: what is read, what is left out, what is refused.
#include <cmath>

#include "scenes/builtin/material_balls.h"
#include "scenes/gltf/expect_refused.h"
#include "scenes/gltf/lobed_quad.h"
#include "scenes/load.h"
#include "scenes/scene_info.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Material;
using scenes::Scene;
using scenes::TextureSlot;

constexpr const char *kCoat = "KHR_materials_clearcoat", *kSheen = "KHR_materials_sheen";

// Every member of both extensions, each texture with an image of its own.
json makeExtensions() {
  json moved = textured(1);
  moved["extensions"] = {{"KHR_texture_transform", {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"texCoord", 1}}}};
  json bumps = textured(2, 1);
  bumps["scale"] = 0.75;
  return {{kCoat,
           {{"clearcoatFactor", 0.5},
            {"clearcoatTexture", textured(0)},
            {"clearcoatRoughnessFactor", 0.25},
            {"clearcoatRoughnessTexture", moved},
            {"clearcoatNormalTexture", bumps}}},
          {kSheen,
           {{"sheenColorFactor", {0.1, 0.2, 0.3}},
            {"sheenColorTexture", textured(3)},
            {"sheenRoughnessFactor", 0.4},
            {"sheenRoughnessTexture", textured(4, 1)}}}};
}

std::size_t countTextures(const Material& m) {
  std::size_t count = 0;
  for (const TextureSlot* slot :
       {&m.coatTexture, &m.coatRoughnessTexture, &m.coatNormalTexture, &m.sheenColorTexture, &m.sheenRoughnessTexture})
    count += slot->present();
  return count;
}

TEST(GltfLobes, ReadEveryValueAndTexture) {
  const Scene scene = loadWithExtensions(makeExtensions());
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.coat, 0.5f);
  EXPECT_EQ(m.coatRoughness, 0.25f);
  EXPECT_EQ(m.coatNormalScale, 0.75f);
  EXPECT_EQ(m.sheenColor, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.sheenRoughness, 0.4f);
  EXPECT_EQ(widthOf(scene, m.coatTexture), 4);
  EXPECT_EQ(widthOf(scene, m.coatRoughnessTexture), 5);
  EXPECT_EQ(widthOf(scene, m.coatNormalTexture), 6);
  EXPECT_EQ(widthOf(scene, m.sheenColorTexture), 7);
  EXPECT_EQ(widthOf(scene, m.sheenRoughnessTexture), 8);
  EXPECT_EQ(m.coatRoughnessTexture.uvTransform, (std::array<float, 6>{2, 0, 0.25f, 0, 3, 0.5f}));
  EXPECT_EQ(m.coatRoughnessTexture.texCoord, 1) << "of the transform";
  EXPECT_EQ(m.coatTexture.texCoord, 0);
  EXPECT_EQ(m.coatNormalTexture.texCoord, 1);
  EXPECT_EQ(m.sheenRoughnessTexture.texCoord, 1);
  EXPECT_EQ(m.sheenColorTexture.sampler.wrapU, scenes::Wrap::clampToEdge);
  EXPECT_EQ(m.sheenColorTexture.sampler.wrapV, scenes::Wrap::mirroredRepeat);
  EXPECT_TRUE(m.hasCoat() && m.hasSheen() && scene.hasLobes());
  EXPECT_TRUE(m.notModelled.empty());
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(GltfLobes, AreNoneByDefault) {
  for (const json& extensions : {json::object(), json({{kCoat, json::object()}, {kSheen, json::object()}})}) {
    const Scene scene = loadWithExtensions(extensions);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.coat, 0.f);
    EXPECT_EQ(m.coatRoughness, 0.f);
    EXPECT_EQ(m.coatNormalScale, 1.f);
    EXPECT_EQ(m.sheenColor, glm::vec3(0));
    EXPECT_EQ(m.sheenRoughness, 0.f);
    EXPECT_FALSE(m.hasCoat() || m.hasSheen() || scene.hasLobes());
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(GltfLobes, ClampFactorsOutOfRangeWithAWarningEach) {
  const Scene scene = loadWithExtensions({{kCoat, {{"clearcoatFactor", 1.5}, {"clearcoatRoughnessFactor", -0.5}}},
                                          {kSheen, {{"sheenColorFactor", {2, -1, 0.5}}, {"sheenRoughnessFactor", 7}}}});
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.coat, 1.f);
  EXPECT_EQ(m.coatRoughness, 0.f);
  EXPECT_EQ(m.sheenColor, glm::vec3(1, 0, 0.5f));
  EXPECT_EQ(m.sheenRoughness, 1.f);
  EXPECT_TRUE(hasWarning(scene.warnings, "/materials/0: clearcoatFactor of 1.5 is out of range, 1 is used"));
  EXPECT_TRUE(hasWarning(scene.warnings, "/materials/0: clearcoatRoughnessFactor of -0.5 is out of range, 0 is used"));
  EXPECT_TRUE(hasWarning(scene.warnings, "/materials/0: sheenColorFactor of 2 is out of range, 1 is used"));
  EXPECT_TRUE(hasWarning(scene.warnings, "/materials/0: sheenColorFactor of -1 is out of range, 0 is used"));
  EXPECT_TRUE(hasWarning(scene.warnings, "/materials/0: sheenRoughnessFactor of 7 is out of range, 1 is used"));
  EXPECT_EQ(scene.warnings.size(), 5u);
}

TEST(GltfLobes, OfBadTypesLengthsAndIndicesAreRefusedWithTheirPlace) {
  const auto expectBad = [](const char* extension, const char* key, const json& value, const std::string& reason) {
    GltfFile file = makeLobed();
    file.material()["extensions"] = makeExtensions();
    file.material()["extensions"][extension][key] = value;
    expectRefused(file, {".glb: /materials/0/extensions/" + std::string(extension) + "/" + key + reason});
  };
  expectBad(kCoat, "clearcoatFactor", "1", ": is \"1\", expected a number");
  expectBad(kCoat, "clearcoatRoughnessFactor", json::array({1}), ": is an array of 1, expected a number");
  expectBad(kCoat, "clearcoatTexture", 0, ": is 0, expected an object");
  expectBad(kCoat, "clearcoatTexture", json::object(), "/index: is missing");
  expectBad(kCoat, "clearcoatRoughnessTexture", textured(5), "/index: is 5, expected an index of textures, 0 to 4");
  expectBad(kCoat, "clearcoatNormalTexture", {{"index", 0}, {"scale", "big"}}, "/scale: is \"big\", expected a number");
  expectBad(kCoat, "clearcoatNormalTexture", {{"index", 0}, {"texCoord", -1}}, "/texCoord: is -1");
  expectBad(kSheen, "sheenColorFactor", {1, 1}, ": holds 2 numbers, expected 3");
  expectBad(kSheen, "sheenColorFactor", {1, "x", 1}, "/1: is \"x\", expected a number");
  expectBad(kSheen, "sheenRoughnessFactor", true, ": is true, expected a number");
  expectBad(kSheen, "sheenColorTexture", textured(-1), "/index: is -1");
  expectBad(kSheen, "sheenRoughnessTexture",
            {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", 2}}}}}},
            "/extensions/KHR_texture_transform/scale: is 2, expected an array");
  for (const char* extension : {kCoat, kSheen}) {
    GltfFile file = makeLobed();
    file.material()["extensions"][extension] = 1;
    expectRefused(file, {"/materials/0/extensions/" + std::string(extension) + ": is 1, expected an object"});
  }
}

TEST(GltfLobes, MayBeRequired) {
  GltfFile file = makeLobed();
  file.material()["extensions"] = makeExtensions();
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {kCoat, kSheen, "KHR_texture_transform"};
  EXPECT_TRUE(loadQuadlike(file).warnings.empty());
}

// Only what can change the colour is kept, and only images that are kept are decoded.
TEST(GltfLobes, LeaveOutTexturesThatCannotChangeTheColor) {
  json extensions = makeExtensions();
  extensions[kCoat]["clearcoatFactor"] = 0;
  Scene scene = loadWithExtensions(extensions);
  EXPECT_EQ(countTextures(scene.materials[0]), 2u) << "the sheen's";
  EXPECT_EQ(scene.images.size(), 2u);
  EXPECT_TRUE(scene.meshes[0].tangents.empty()) << "nothing reads them";
  extensions[kSheen]["sheenColorFactor"] = {0, 0, 0};
  scene = loadWithExtensions(extensions);
  EXPECT_EQ(countTextures(scene.materials[0]), 0u);
  EXPECT_TRUE(scene.images.empty());
  extensions = makeExtensions();
  extensions[kCoat].erase("clearcoatRoughnessFactor"); // 0 by default, which the texture scales
  extensions[kSheen].erase("sheenRoughnessFactor");
  scene = loadWithExtensions(extensions);
  EXPECT_EQ(countTextures(scene.materials[0]), 3u);
  EXPECT_FALSE(scene.materials[0].coatRoughnessTexture.present());
  EXPECT_FALSE(scene.materials[0].sheenRoughnessTexture.present());
}

TEST(GltfLobes, AreNotOfUnlitMaterials) {
  json extensions = makeExtensions();
  extensions["KHR_materials_unlit"] = json::object();
  const Scene scene = loadWithExtensions(extensions);
  EXPECT_FALSE(scene.materials[0].hasCoat() || scene.materials[0].hasSheen() || scene.hasLobes());
  EXPECT_EQ(countTextures(scene.materials[0]), 0u);
  EXPECT_TRUE(scene.images.empty());
}

TEST(GltfLobes, ANormalMapOfTheCoatAloneHasTangentsInItsOwnUvs) {
  const Scene scene =
      loadWithExtensions({{kCoat, {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", textured(0, 1)}}}});
  ASSERT_EQ(scene.meshes[0].tangents.size(), scene.meshes[0].positions.size());
  for (const glm::vec4& tangent : scene.meshes[0].tangents)
    EXPECT_NEAR(std::abs(tangent.y), 1, 1e-6) << "u of the second set runs along y";
  const Scene balls = scenes::makeMaterialBalls(scene);
  EXPECT_EQ(balls.meshes[0].tangents.size(), balls.meshes[0].positions.size());
}

TEST(GltfLobes, ANormalMapOfTheCoatAloneTakesTheTangentsOfTheFile) {
  GltfFile file = makeLobed();
  file.primitive()["attributes"]["TANGENT"] =
      file.add<float>({0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1, 0.6f, 0.8f, 0, -1}, "VEC4");
  file.material()["extensions"] = {{kCoat, {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", textured(0)}}}};
  EXPECT_EQ(loadQuadlike(file).meshes[0].tangents.at(0), glm::vec4(0.6f, 0.8f, 0, -1));
}

TEST(GltfLobes, BothNormalMapsTakeTheTangentsOfTheBaseAndTheFileIsToldSo) {
  GltfFile file = makeLobed();
  file.material() = {{"normalTexture", textured(1)},
                     {"extensions", {{kCoat, {{"clearcoatFactor", 1}, {"clearcoatNormalTexture", textured(0, 1)}}}}}};
  const Scene scene = loadQuadlike(file);
  for (const glm::vec4& tangent : scene.meshes[0].tangents) EXPECT_NEAR(tangent.x, 1, 1e-6);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "/materials/0: the normal map of the coat uses TEXCOORD_1, that of the base TEXCOORD_0; "
                               "both take their tangents from the base's, so the coat's bumps may be turned");
  file.material()["extensions"][kCoat]["clearcoatNormalTexture"] = textured(0);
  EXPECT_TRUE(loadQuadlike(file).warnings.empty()) << "the same set";
}

TEST(GltfLobes, CountAmongTheUvSetsOfTheirMaterial) {
  GltfFile file = makeLobed();
  file.primitive()["attributes"]["TEXCOORD_4"] = file.add<float>({1, 2, 3, 4, 5, 6, 7, 8}, "VEC2");
  file.material()["extensions"] = {{kCoat, {{"clearcoatFactor", 1}, {"clearcoatTexture", textured(0, 4)}}},
                                   {kSheen, {{"sheenColorFactor", {1, 1, 1}}, {"sheenColorTexture", textured(1)}}}};
  Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.materials[0].coatTexture.texCoord, 1);
  EXPECT_EQ(scene.materials[0].sheenColorTexture.texCoord, 0);
  EXPECT_EQ(scene.meshes[0].uv1.at(0), glm::vec2(1, 2));
  file.material()["extensions"][kCoat]["clearcoatNormalTexture"] = textured(2, 7);
  scene = loadQuadlike(file);
  EXPECT_FALSE(scene.materials[0].coatNormalTexture.present()) << "a third set";
  EXPECT_EQ(scene.materials[0].notModelled.size(), 1u);
  file.primitive()["attributes"].erase("TEXCOORD_4");
  EXPECT_TRUE(hasWarning(loadQuadlike(file).warnings,
                         "the clearcoatTexture of material 'paint' needs TEXCOORD_4, which the mesh lacks"));
}

TEST(GltfLobes, AreInTheWordsAboutTheScene) {
  const Scene scene = loadWithExtensions(makeExtensions());
  const scenes::MaterialInfo info = scenes::describeScene(scene).materials.at(0);
  EXPECT_EQ(info.flags, (std::vector<std::string>{"textured", "coat", "sheen"}));
  ASSERT_EQ(info.textures.size(), 5u);
  EXPECT_TRUE(info.textures[0].starts_with("coat: ")) << info.textures[0];
  EXPECT_TRUE(info.textures[2].starts_with("coat normal: ")) << info.textures[2];
  EXPECT_TRUE(info.textures[4].starts_with("sheen roughness: ")) << info.textures[4];
}

} // namespace
} // namespace parity::tests
