// KHR_materials_transmission, _volume, _dispersion and _diffuse_transmission: what is read, what is left out, what is
// refused.
#include <cmath>

#include "scenes/gltf/expect_refused.h"
#include "scenes/gltf/lobed_quad.h"
#include "scenes/load.h"
#include "scenes/scene_info.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Material;
using scenes::Scene;

constexpr const char *kTransmission = "KHR_materials_transmission", *kVolume = "KHR_materials_volume",
                     *kDispersion = "KHR_materials_dispersion", *kDiffuse = "KHR_materials_diffuse_transmission";

// Every member of the four, each texture with an image of its own.
json makeAll() {
  json moved = textured(1);
  moved["extensions"] = {{"KHR_texture_transform", {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"texCoord", 1}}}};
  return {{kTransmission, {{"transmissionFactor", 0.5}, {"transmissionTexture", textured(0)}}},
          {kVolume,
           {{"thicknessFactor", 0.125},
            {"thicknessTexture", moved},
            {"attenuationDistance", 2.5},
            {"attenuationColor", {0.25, 0.5, 0.75}}}},
          {"KHR_materials_ior", {{"ior", 1.75}}},
          {kDispersion, {{"dispersion", 0.375}}},
          {kDiffuse,
           {{"diffuseTransmissionFactor", 0.75},
            {"diffuseTransmissionTexture", textured(2)},
            {"diffuseTransmissionColorFactor", {0.125, 0.25, 0.375}},
            {"diffuseTransmissionColorTexture", textured(3, 1)}}}};
}

TEST(GltfTransmission, ReadsEveryValueAndTexture) {
  const Scene scene = loadWithExtensions(makeAll());
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.transmission, 0.5f);
  EXPECT_EQ(m.thickness, 0.125f);
  EXPECT_EQ(m.attenuationDistance, 2.5f);
  EXPECT_EQ(m.attenuationColor, glm::vec3(0.25f, 0.5f, 0.75f));
  EXPECT_EQ(m.ior, 1.75f);
  EXPECT_EQ(m.dispersion, 0.375f);
  EXPECT_EQ(m.diffuseTransmission, 0.75f);
  EXPECT_EQ(m.diffuseTransmissionColor, glm::vec3(0.125f, 0.25f, 0.375f));
  EXPECT_EQ(widthOf(scene, m.transmissionTexture), 4);
  EXPECT_EQ(widthOf(scene, m.thicknessTexture), 5);
  EXPECT_EQ(widthOf(scene, m.diffuseTransmissionTexture), 6);
  EXPECT_EQ(widthOf(scene, m.diffuseTransmissionColorTexture), 7);
  EXPECT_EQ(m.thicknessTexture.uvTransform, (std::array<float, 6>{2, 0, 0.25f, 0, 3, 0.5f}));
  EXPECT_EQ(m.thicknessTexture.texCoord, 1) << "of the transform";
  EXPECT_EQ(m.diffuseTransmissionColorTexture.texCoord, 1);
  EXPECT_TRUE(m.hasTransmission() && m.hasDiffuseTransmission() && m.hasVolume() && m.hasLobes() && scene.hasLobes());
  EXPECT_TRUE(m.notModelled.empty());
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(GltfTransmission, IsNoneByDefault) {
  for (const json& extensions : {json::object(), json({{kTransmission, json::object()},
                                                       {kVolume, json::object()},
                                                       {kDispersion, json::object()},
                                                       {kDiffuse, json::object()}})}) {
    const Scene scene = loadWithExtensions(extensions);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.transmission, 0.f);
    EXPECT_EQ(m.thickness, 0.f);
    EXPECT_EQ(m.absorption(), glm::vec3(0));
    EXPECT_EQ(m.dispersion, 0.f);
    EXPECT_EQ(m.diffuseTransmission, 0.f);
    EXPECT_EQ(m.diffuseTransmissionColor, glm::vec3(1));
    EXPECT_FALSE(m.hasLobes() || m.hasVolume() || scene.hasLobes());
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(GltfTransmission, ClampsValuesOutOfRangeWithAWarningEach) {
  const Scene scene = loadWithExtensions(
      {{kTransmission, {{"transmissionFactor", 1.5}}},
       {kVolume, {{"thicknessFactor", -1}, {"attenuationDistance", -2}, {"attenuationColor", {2, 0.5, 1}}}},
       {kDispersion, {{"dispersion", 1e9}}},
       {kDiffuse, {{"diffuseTransmissionFactor", -3}, {"diffuseTransmissionColorFactor", {1, -1, 1}}}}});
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.transmission, 1.f);
  EXPECT_EQ(m.thickness, 0.f);
  EXPECT_EQ(m.attenuationDistance, 0.f);
  EXPECT_EQ(m.attenuationColor, glm::vec3(1, 0.5f, 1));
  EXPECT_EQ(m.dispersion, 20.f);
  EXPECT_EQ(m.diffuseTransmission, 0.f);
  EXPECT_EQ(m.diffuseTransmissionColor, glm::vec3(1, 0, 1));
  for (const char* warning :
       {"transmissionFactor of 1.5 is out of range, 1 is used", "thicknessFactor of -1 is out of range, 0 is used",
        "attenuationDistance of -2 is out of range, 0 is used", "attenuationColor of 2 is out of range, 1 is used",
        "dispersion of 1000000000 is out of range, 20 is used",
        "diffuseTransmissionFactor of -3 is out of range, 0 is used",
        "diffuseTransmissionColorFactor of -1 is out of range, 0 is used"})
    EXPECT_TRUE(hasWarning(scene.warnings, std::string("/materials/0: ") + warning)) << warning;
  EXPECT_EQ(scene.warnings.size(), 7u);
}

TEST(GltfTransmission, ClampsTheOtherEndOfEachRange) {
  const Scene scene = loadWithExtensions(
      {{kTransmission, {{"transmissionFactor", -0.5}}},
       {kVolume, {{"thicknessFactor", 1e30}, {"attenuationDistance", 1e30}, {"attenuationColor", {1, 1, -1}}}},
       {kDispersion, {{"dispersion", -0.5}}},
       {kDiffuse, {{"diffuseTransmissionFactor", 1.5}, {"diffuseTransmissionColorFactor", {1, 2, 1}}}}});
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.transmission, 0.f);
  EXPECT_EQ(m.thickness, 1e18f);
  EXPECT_EQ(m.attenuationDistance, 1e18f);
  EXPECT_EQ(m.attenuationColor, glm::vec3(1, 1, 0));
  EXPECT_EQ(m.dispersion, 0.f);
  EXPECT_EQ(m.diffuseTransmission, 1.f);
  EXPECT_EQ(m.diffuseTransmissionColor, glm::vec3(1));
  EXPECT_EQ(scene.warnings.size(), 7u);
  const Scene body = loadWithExtensions({{kTransmission, {{"transmissionFactor", 1}}},
                                         {kVolume, {{"thicknessFactor", 7.5}, {"attenuationDistance", 1e6}}},
                                         {kDispersion, {{"dispersion", 20}}}});
  EXPECT_EQ(body.materials.at(0).thickness, 7.5f);
  EXPECT_EQ(body.materials.at(0).attenuationDistance, 1e6f);
  EXPECT_TRUE(body.warnings.empty()) << "all within their ranges";
}

TEST(GltfTransmission, AnAttenuationDistanceOfZeroAbsorbsNothing) {
  for (const double distance : {0.0, 1e-60}) {
    const Scene scene = loadWithExtensions(
        {{kTransmission, {{"transmissionFactor", 1}}},
         {kVolume, {{"thicknessFactor", 1}, {"attenuationDistance", distance}, {"attenuationColor", {0, 0, 0}}}}});
    EXPECT_EQ(scene.materials.at(0).absorption(), glm::vec3(0));
    ASSERT_EQ(scene.warnings.size(), 1u) << distance;
    EXPECT_EQ(scene.warnings[0], "/materials/0: attenuationDistance of 0 is out of range, nothing is absorbed");
  }
}

TEST(GltfTransmission, AnIndexOf0StaysThatOfAMirror) {
  json extensions = makeAll();
  extensions["KHR_materials_ior"]["ior"] = 0;
  const Scene scene = loadWithExtensions(extensions);
  EXPECT_EQ(scene.materials.at(0).ior, 0.f);
  EXPECT_EQ(scene.materials.at(0).dielectricF0(), glm::vec3(1));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfTransmission, TexturesTakePartInTheChoiceOfUvSets) {
  GltfFile file = makeLobed();
  file.primitive()["attributes"]["TEXCOORD_2"] = file.add<float>({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2");
  file.material()["extensions"] = {
      {kTransmission, {{"transmissionFactor", 1}, {"transmissionTexture", textured(0, 2)}}},
      {kVolume, {{"thicknessFactor", 1}, {"thicknessTexture", textured(1, 1)}}},
      {kDiffuse,
       {{"diffuseTransmissionFactor", 1},
        {"diffuseTransmissionTexture", textured(2, 2)},
        {"diffuseTransmissionColorTexture", textured(3, 0)}}}};
  const Scene scene = loadQuadlike(file);
  const Material& m = scene.materials.at(0);
  EXPECT_FALSE(m.transmissionTexture.present() || m.diffuseTransmissionTexture.present()) << "of the third set";
  EXPECT_EQ(widthOf(scene, m.thicknessTexture), 5);
  EXPECT_EQ(widthOf(scene, m.diffuseTransmissionColorTexture), 7);
  EXPECT_EQ(m.notModelled.size(), 1u);
  EXPECT_TRUE(hasWarning(scene.warnings, "a third uv set"));
}

// Light keeps the colour over the distance.
TEST(GltfTransmission, AbsorptionFollowsColorAndDistance) {
  Material m;
  m.attenuationColor = glm::vec3(0.25f, 1, 0);
  EXPECT_EQ(m.absorption(), glm::vec3(0)) << "no distance: nothing is absorbed";
  m.attenuationDistance = 2;
  const glm::vec3 sigma = m.absorption();
  EXPECT_NEAR(std::exp(-2 * sigma.x), 0.25f, 1e-6f);
  EXPECT_EQ(sigma.y, 0.f);
  EXPECT_TRUE(std::isfinite(sigma.z));
  EXPECT_LT(std::exp(-2 * sigma.z), 1e-5f);
  m.attenuationDistance = 1e-40f;
  EXPECT_EQ(std::exp(-m.absorption().x * 0.f), 1.f) << "over no distance nothing is absorbed";
}

TEST(GltfTransmission, OfBadTypesAndIndicesIsRefusedWithItsPlace) {
  const auto expectBad = [](const char* extension, const char* key, const json& value, const std::string& reason) {
    GltfFile file = makeLobed();
    file.material()["extensions"] = makeAll();
    file.material()["extensions"][extension][key] = value;
    expectRefused(file, {".glb: /materials/0/extensions/" + std::string(extension) + "/" + key + reason});
  };
  expectBad(kTransmission, "transmissionFactor", "1", ": is \"1\", expected a number");
  expectBad(kTransmission, "transmissionTexture", textured(5), "/index: is 5, expected an index of textures, 0 to 4");
  expectBad(kVolume, "thicknessFactor", json::array({1}), ": is an array of 1, expected a number");
  expectBad(kVolume, "thicknessTexture", 0, ": is 0, expected an object");
  expectBad(kVolume, "attenuationDistance", "far", ": is \"far\", expected a number");
  expectBad(kVolume, "attenuationColor", 1, ": is 1, expected an array");
  expectBad(kDispersion, "dispersion", true, ": is true, expected a number");
  expectBad(kDiffuse, "diffuseTransmissionFactor", json::object(), ": is an object, expected a number");
  expectBad(kDiffuse, "diffuseTransmissionTexture", json::object(), "/index: is missing");
  expectBad(kDiffuse, "diffuseTransmissionColorTexture", {{"index", 0}, {"texCoord", -1}}, "/texCoord: is -1");
  for (const char* extension : {kTransmission, kVolume, kDispersion, kDiffuse}) {
    GltfFile file = makeLobed();
    file.material()["extensions"][extension] = 1;
    expectRefused(file, {"/materials/0/extensions/" + std::string(extension) + ": is 1, expected an object"});
  }
}

TEST(GltfTransmission, MayBeRequired) {
  GltfFile file = makeLobed();
  file.material()["extensions"] = makeAll();
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {
      kTransmission, kVolume, kDispersion, kDiffuse, "KHR_materials_ior", "KHR_texture_transform"};
  EXPECT_TRUE(loadQuadlike(file).warnings.empty());
}

TEST(GltfTransmission, LeavesOutTexturesThatCannotChangeTheColor) {
  json extensions = makeAll();
  extensions[kTransmission]["transmissionFactor"] = 0;
  Scene scene = loadWithExtensions(extensions);
  EXPECT_FALSE(scene.materials[0].transmissionTexture.present());
  EXPECT_TRUE(scene.materials[0].thicknessTexture.present()) << "diffuse light passes a body, too";
  EXPECT_EQ(scene.images.size(), 3u);
  extensions[kDiffuse]["diffuseTransmissionFactor"] = 0;
  scene = loadWithExtensions(extensions);
  EXPECT_FALSE(scene.materials[0].hasVolume()) << "no light enters it";
  EXPECT_TRUE(scene.images.empty());
  extensions = makeAll();
  extensions[kVolume]["thicknessFactor"] = 0;
  extensions[kDiffuse]["diffuseTransmissionColorFactor"] = {0, 0, 0};
  scene = loadWithExtensions(extensions);
  EXPECT_FALSE(scene.materials[0].thicknessTexture.present() || scene.materials[0].hasVolume());
  EXPECT_FALSE(scene.materials[0].diffuseTransmissionColorTexture.present());
  extensions = makeAll();
  extensions["KHR_materials_unlit"] = json::object();
  scene = loadWithExtensions(extensions);
  EXPECT_FALSE(scene.materials[0].hasLobes() || scene.hasLobes());
  EXPECT_TRUE(scene.images.empty());
}

TEST(GltfTransmission, IsInTheWordsAboutTheScene) {
  const scenes::MaterialInfo info = scenes::describeScene(loadWithExtensions(makeAll())).materials.at(0);
  EXPECT_EQ(info.flags, (std::vector<std::string>{"textured", "transmission", "diffuse transmission", "volume"}));
  ASSERT_EQ(info.textures.size(), 4u);
  EXPECT_TRUE(info.textures[0].starts_with("transmission: ")) << info.textures[0];
  EXPECT_TRUE(info.textures[1].starts_with("thickness: ")) << info.textures[1];
  EXPECT_TRUE(info.textures[2].starts_with("diffuse transmission: ")) << info.textures[2];
  EXPECT_TRUE(info.textures[3].starts_with("diffuse transmission color: ")) << info.textures[3];
}

TEST(Material, CastsNoShadowWhereMostLightPasses) {
  Material m;
  EXPECT_TRUE(m.castsShadow());
  m.transmission = 0.5f;
  EXPECT_TRUE(m.castsShadow());
  m.transmission = 0.6f;
  EXPECT_FALSE(m.castsShadow());
  m.unlit = true;
  EXPECT_FALSE(m.castsShadow());
  m.unlit = false;
  m.transmission = 0;
  m.diffuseTransmission = 1;
  EXPECT_TRUE(m.castsShadow()) << "leaves do";
  m.alphaMode = scenes::AlphaMode::blend;
  EXPECT_FALSE(m.castsShadow());
}

} // namespace
} // namespace parity::tests
