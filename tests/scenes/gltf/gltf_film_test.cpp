// KHR_materials_anisotropy and KHR_materials_iridescence: what is read, what is left out, what is refused.
#include <cmath>
#include <numbers>

#include "scenes/gltf/expect_refused.h"
#include "scenes/gltf/lobed_quad.h"
#include "scenes/load.h"
#include "scenes/scene_info.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::Material;
using scenes::Scene;

constexpr const char *kAnisotropy = "KHR_materials_anisotropy", *kIridescence = "KHR_materials_iridescence";

// Every member of both extensions, each texture with an image of its own.
json makeBoth() {
  json moved = textured(0);
  moved["extensions"] = {{"KHR_texture_transform", {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"texCoord", 1}}}};
  json turned = textured(2);
  turned["extensions"] = {{"KHR_texture_transform", {{"scale", {4, 5}}}}};
  return {{kAnisotropy, {{"anisotropyStrength", 0.5}, {"anisotropyRotation", -0.75}, {"anisotropyTexture", moved}}},
          {kIridescence,
           {{"iridescenceFactor", 0.25},
            {"iridescenceTexture", textured(1, 1)},
            {"iridescenceIor", 1.75},
            {"iridescenceThicknessMinimum", 50},
            {"iridescenceThicknessMaximum", 650},
            {"iridescenceThicknessTexture", turned}}}};
}

json filmOf(const json& members) { return {{kIridescence, members}}; }

TEST(GltfFilm, ReadsEveryValueAndTexture) {
  const Scene scene = loadWithExtensions(makeBoth());
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.anisotropy, 0.5f);
  EXPECT_EQ(m.anisotropyRotation, -0.75f);
  EXPECT_EQ(m.iridescence, 0.25f);
  EXPECT_EQ(m.iridescenceIor, 1.75f);
  EXPECT_EQ(m.iridescenceThicknessMin, 50.f);
  EXPECT_EQ(m.iridescenceThicknessMax, 650.f);
  EXPECT_EQ(widthOf(scene, m.anisotropyTexture), 4);
  EXPECT_EQ(widthOf(scene, m.iridescenceTexture), 5);
  EXPECT_EQ(widthOf(scene, m.iridescenceThicknessTexture), 6);
  EXPECT_EQ(m.anisotropyTexture.uvTransform, (std::array<float, 6>{2, 0, 0.25f, 0, 3, 0.5f}));
  EXPECT_EQ(m.anisotropyTexture.texCoord, 1) << "of the transform";
  EXPECT_EQ(m.iridescenceTexture.texCoord, 1);
  EXPECT_EQ(m.iridescenceThicknessTexture.texCoord, 0);
  EXPECT_EQ(m.iridescenceThicknessTexture.uvTransform, (std::array<float, 6>{4, 0, 0, 0, 5, 0}));
  EXPECT_EQ(m.anisotropyTexture.sampler.wrapU, scenes::Wrap::clampToEdge);
  EXPECT_TRUE(m.hasAnisotropy() && m.hasIridescence() && m.hasLobes() && scene.hasLobes());
  EXPECT_TRUE(m.notModelled.empty());
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST(GltfFilm, IsNoneByDefaultAndThinAsTheSpecificationSays) {
  for (const json& extensions :
       {json::object(), json({{kAnisotropy, json::object()}, {kIridescence, json::object()}})}) {
    const Scene scene = loadWithExtensions(extensions);
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.anisotropy, 0.f);
    EXPECT_EQ(m.anisotropyRotation, 0.f);
    EXPECT_EQ(m.iridescence, 0.f);
    EXPECT_EQ(m.iridescenceIor, 1.3f);
    EXPECT_EQ(m.iridescenceThicknessMin, 100.f);
    EXPECT_EQ(m.iridescenceThicknessMax, 400.f);
    EXPECT_FALSE(m.hasLobes() || scene.hasLobes());
    EXPECT_TRUE(scene.meshes[0].tangents.empty()) << "nothing reads them";
    EXPECT_TRUE(scene.warnings.empty());
  }
}

TEST(GltfFilm, ClampsValuesOutOfRangeWithAWarningEach) {
  const Scene scene = loadWithExtensions({{kAnisotropy, {{"anisotropyStrength", 1.5}}},
                                          {kIridescence,
                                           {{"iridescenceFactor", 7},
                                            {"iridescenceIor", 0.5},
                                            {"iridescenceThicknessMinimum", -1},
                                            {"iridescenceThicknessMaximum", -200}}}});
  const Material& m = scene.materials.at(0);
  EXPECT_EQ(m.anisotropy, 1.f);
  EXPECT_EQ(m.iridescence, 1.f);
  EXPECT_EQ(m.iridescenceIor, 1.f);
  EXPECT_EQ(m.iridescenceThicknessMin, 0.f);
  EXPECT_EQ(m.iridescenceThicknessMax, 0.f);
  for (const char* warning :
       {"anisotropyStrength of 1.5 is out of range, 1 is used", "iridescenceFactor of 7 is out of range, 1 is used",
        "iridescenceIor of 0.5 is out of range, 1 is used",
        "iridescenceThicknessMinimum of -1 is out of range, 0 is used",
        "iridescenceThicknessMaximum of -200 is out of range, 0 is used"})
    EXPECT_TRUE(hasWarning(scene.warnings, std::string("/materials/0: ") + warning)) << warning;
  EXPECT_EQ(scene.warnings.size(), 5u);
  EXPECT_EQ(loadWithExtensions(anisotropyOf({{"anisotropyStrength", -2}})).materials[0].anisotropy, 0.f);
}

TEST(GltfFilm, TakesAnyRotationAndThicknessesInEitherOrder) {
  const auto rotationOf = [](double value) {
    const Scene scene = loadWithExtensions(anisotropyOf({{"anisotropyStrength", 1}, {"anisotropyRotation", value}}));
    EXPECT_TRUE(scene.warnings.empty());
    return scene.materials[0].anisotropyRotation;
  };
  EXPECT_EQ(rotationOf(-6.25), -6.25f) << "as the file has it";
  EXPECT_NEAR(rotationOf(1 + 2000 * std::numbers::pi), 1, 1e-6) << "a float of 6284 would be off by 2e-4";
  EXPECT_LE(std::abs(rotationOf(1e30)), 3.15f);
  const Scene scene = loadWithExtensions(filmOf({{"iridescenceFactor", 1},
                                                 {"iridescenceThicknessMinimum", 500},
                                                 {"iridescenceThicknessMaximum", 0},
                                                 {"iridescenceThicknessTexture", textured(0)}}));
  EXPECT_TRUE(scene.materials[0].hasIridescence());
  EXPECT_EQ(scene.materials[0].iridescenceThicknessMin, 500.f);
  EXPECT_TRUE(scene.materials[0].iridescenceThicknessTexture.present());
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(GltfFilm, OfBadTypesAndIndicesIsRefusedWithItsPlace) {
  const auto expectBad = [](const char* extension, const char* key, const json& value, const std::string& reason) {
    GltfFile file = makeLobed();
    file.material()["extensions"] = makeBoth();
    file.material()["extensions"][extension][key] = value;
    expectRefused(file, {".glb: /materials/0/extensions/" + std::string(extension) + "/" + key + reason});
  };
  expectBad(kAnisotropy, "anisotropyStrength", "1", ": is \"1\", expected a number");
  expectBad(kAnisotropy, "anisotropyRotation", json::array({1}), ": is an array of 1, expected a number");
  expectBad(kAnisotropy, "anisotropyTexture", 0, ": is 0, expected an object");
  expectBad(kAnisotropy, "anisotropyTexture", textured(5), "/index: is 5, expected an index of textures, 0 to 4");
  expectBad(kIridescence, "iridescenceFactor", true, ": is true, expected a number");
  expectBad(kIridescence, "iridescenceIor", "1.3", ": is \"1.3\", expected a number");
  expectBad(kIridescence, "iridescenceThicknessMinimum", json::object(), ": is an object, expected a number");
  expectBad(kIridescence, "iridescenceThicknessMaximum", "thick", ": is \"thick\", expected a number");
  expectBad(kIridescence, "iridescenceTexture", json::object(), "/index: is missing");
  expectBad(kIridescence, "iridescenceThicknessTexture", {{"index", 0}, {"texCoord", -1}}, "/texCoord: is -1");
  for (const char* extension : {kAnisotropy, kIridescence}) {
    GltfFile file = makeLobed();
    file.material()["extensions"][extension] = 1;
    expectRefused(file, {"/materials/0/extensions/" + std::string(extension) + ": is 1, expected an object"});
  }
}

TEST(GltfFilm, MayBeRequired) {
  GltfFile file = makeLobed();
  file.material()["extensions"] = makeBoth();
  file.json["extensionsUsed"] = file.json["extensionsRequired"] = {kAnisotropy, kIridescence, "KHR_texture_transform"};
  EXPECT_TRUE(loadQuadlike(file).warnings.empty());
}

TEST(GltfFilm, LeavesOutTexturesThatCannotChangeTheColor) {
  json extensions = makeBoth();
  extensions[kAnisotropy]["anisotropyStrength"] = 0;
  Scene scene = loadWithExtensions(extensions);
  EXPECT_FALSE(scene.materials[0].anisotropyTexture.present());
  EXPECT_EQ(scene.images.size(), 2u) << "the film's";
  EXPECT_TRUE(scene.meshes[0].tangents.empty()) << "nothing reads them";
  extensions[kIridescence]["iridescenceFactor"] = 0;
  EXPECT_TRUE(loadWithExtensions(extensions).images.empty());
  extensions = makeBoth();
  extensions[kIridescence]["iridescenceThicknessMinimum"] = 650; // the greatest
  scene = loadWithExtensions(extensions);
  EXPECT_TRUE(scene.materials[0].iridescenceTexture.present());
  EXPECT_FALSE(scene.materials[0].iridescenceThicknessTexture.present());
  EXPECT_EQ(scene.images.size(), 2u);
}

// Without a texture the greatest thickness holds, whatever the least is.
TEST(GltfFilm, OfNoThicknessIsNone) {
  const auto load = [](double least, double greatest, bool texture) {
    json film = {{"iridescenceFactor", 1},
                 {"iridescenceThicknessMinimum", least},
                 {"iridescenceThicknessMaximum", greatest},
                 {"iridescenceTexture", textured(0)}};
    if (texture) film["iridescenceThicknessTexture"] = textured(1);
    return loadWithExtensions(filmOf(film));
  };
  for (const Scene& scene : {load(100, 0, false), load(0, 0, true)}) {
    EXPECT_FALSE(scene.materials[0].hasIridescence() || scene.hasLobes());
    EXPECT_TRUE(scene.images.empty());
    EXPECT_EQ(scenes::describeScene(scene).materials[0].flags, std::vector<std::string>{});
  }
  EXPECT_TRUE(load(100, 0, true).materials[0].hasIridescence()) << "0 where the texture is 1";
  EXPECT_TRUE(load(0, 1, false).materials[0].hasIridescence());
}

TEST(GltfFilm, IsNotOfUnlitMaterials) {
  json extensions = makeBoth();
  extensions["KHR_materials_unlit"] = json::object();
  const Scene scene = loadWithExtensions(extensions);
  EXPECT_FALSE(scene.materials[0].hasLobes() || scene.hasLobes());
  EXPECT_TRUE(scene.images.empty());
  EXPECT_TRUE(scene.meshes[0].tangents.empty());
}

TEST(GltfFilm, IsInTheWordsAboutTheScene) {
  const scenes::MaterialInfo info = scenes::describeScene(loadWithExtensions(makeBoth())).materials.at(0);
  EXPECT_EQ(info.flags, (std::vector<std::string>{"textured", "anisotropy", "iridescence"}));
  ASSERT_EQ(info.textures.size(), 3u);
  EXPECT_TRUE(info.textures[0].starts_with("anisotropy: ")) << info.textures[0];
  EXPECT_TRUE(info.textures[1].starts_with("iridescence: ")) << info.textures[1];
  EXPECT_TRUE(info.textures[2].starts_with("iridescence thickness: ")) << info.textures[2];
}

// Beyond that the path of light in the film would leave the range of floats.
TEST(GltfFilm, HasAGreatestIndexAndThickness) {
  const Scene scene = loadWithExtensions(
      filmOf({{"iridescenceFactor", 1}, {"iridescenceIor", 1e30}, {"iridescenceThicknessMaximum", 1e30}}));
  EXPECT_EQ(scene.materials[0].iridescenceIor, 10.f);
  EXPECT_EQ(scene.materials[0].iridescenceThicknessMax, 1e6f);
}

} // namespace
} // namespace parity::tests
