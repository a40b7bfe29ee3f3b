// Materials, textures and their extensions.

#include <glm/gtc/constants.hpp>

#include "scenes/gltf/gltf_writer.h"
#include "scenes/gltf/texture.h"
#include "scenes/load.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using scenes::AlphaMode;
using scenes::Filter;
using scenes::Material;
using scenes::Scene;
using scenes::Wrap;

Scene loadWithMaterial(const json& material) {
  GltfFile file = makeQuad();
  file.material() = material;
  return loadQuadlike(file);
}

// A quad whose materials may use two textures of one embedded image each.
GltfFile makeTextured() {
  GltfFile file = makeQuad();
  for (int i = 0; i < 2; ++i)
    file.json["images"].push_back(
        {{"bufferView", file.addBufferView(makePng(4 + i, 2))}, {"mimeType", "image/png"}, {"name", "picture"}});
  file.json["textures"] = {{{"source", 0}}, {{"source", 1}, {"sampler", 0}}};
  file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"minFilter", 9728}, {"magFilter", 9728}}};
  return file;
}

TEST(GltfMaterial, ReadsAllFactorsAndFlags) {
  const Material material =
      loadWithMaterial({{"name", "lacquer"},
                        {"pbrMetallicRoughness",
                         {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0}, {"roughnessFactor", 0.25}}},
                        {"emissiveFactor", {0.5, 0, 1}},
                        {"alphaMode", "MASK"},
                        {"alphaCutoff", 0.7},
                        {"doubleSided", true},
                        {"extras", {{"fullyRough", true}}},
                        {"extensions",
                         {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
                          {"KHR_materials_ior", {{"ior", 2}}},
                          {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 2}}}},
                          {"KHR_materials_unlit", json::object()}}}})
          .materials.at(0);
  EXPECT_EQ(material.name, "lacquer");
  EXPECT_EQ(material.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.metallic, 0.f);
  EXPECT_EQ(material.roughness, 0.25f);
  EXPECT_EQ(material.emissive, glm::vec3(2, 0, 4));
  EXPECT_EQ(material.alphaMode, AlphaMode::mask);
  EXPECT_EQ(material.alphaCutoff, 0.7f);
  EXPECT_TRUE(material.doubleSided);
  EXPECT_TRUE(material.fullyRough);
  EXPECT_TRUE(material.unlit);
  EXPECT_EQ(material.ior, 2.f);
  EXPECT_EQ(material.specular, 0.5f);
  EXPECT_EQ(material.specularColor, glm::vec3(1, 0.5f, 2));
}

TEST(GltfMaterial, DefaultsAreThoseOfTheSpecification) {
  const Material material = loadWithMaterial(json::object()).materials.at(0);
  EXPECT_EQ(material.name, "material 0");
  EXPECT_EQ(material.baseColor, glm::vec4(1));
  EXPECT_EQ(material.metallic, 1.f);
  EXPECT_EQ(material.roughness, 1.f);
  EXPECT_EQ(material.emissive, glm::vec3(0));
  EXPECT_EQ(material.alphaCutoff, 0.5f);
  EXPECT_EQ(material.ior, 1.5f);
  EXPECT_FALSE(material.doubleSided || material.unlit || material.fullyRough);
  EXPECT_EQ(material.normalScale, 1.f);
  EXPECT_EQ(material.occlusionStrength, 1.f);
}

TEST(GltfMaterial, OnlyTheLiteralTrueOptsInToFullyRough) {
  for (const json& value : {json(1), json("true"), json(false), json(nullptr)})
    EXPECT_FALSE(loadWithMaterial({{"extras", {{"fullyRough", value}}}}).materials[0].fullyRough) << value;
  EXPECT_FALSE(loadWithMaterial({{"extras", 3}}).materials[0].fullyRough);
}

TEST(GltfMaterial, MakesNamesUniqueAndOneLine) {
  GltfFile file = makeQuad();
  file.json["materials"] = {{{"name", "a"}}, {{"name", "a"}},    {{"name", "a (2)"}},
                            json::object(),  {{"name", "b\nc"}}, {{"name", std::string(500, 'x')}}};
  const Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.materials[0].name, "a");
  EXPECT_EQ(scene.materials[1].name, "a (2)");
  EXPECT_EQ(scene.materials[2].name, "a (2) (2)");
  EXPECT_EQ(scene.materials[3].name, "material 3");
  EXPECT_EQ(scene.materials[4].name, "b c");
  EXPECT_EQ(scene.materials[5].name.size(), 128u);
}

TEST(GltfMaterial, ClampsFactorsOutOfRangeWithAWarning) {
  const Scene scene = loadWithMaterial({{"pbrMetallicRoughness", {{"roughnessFactor", 1.5}, {"metallicFactor", -1}}},
                                        {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}});
  EXPECT_EQ(scene.materials[0].roughness, 1.f);
  EXPECT_EQ(scene.materials[0].metallic, 0.f);
  EXPECT_EQ(scene.materials[0].ior, 1.f);
  EXPECT_TRUE(hasWarning(scene.warnings, "/materials/0: roughnessFactor of 1.5 is out of range, 1 is used"));
  EXPECT_EQ(scene.warnings.size(), 3u);
}

TEST(GltfMaterial, SaysOncePerMaterialWhatIsNotModelled) {
  const Scene scene = loadWithMaterial({{"name", "paint"},
                                        {"alphaMode", "BLEND"},
                                        {"extensions",
                                         {{"KHR_materials_subsurface", json::object()},
                                          {"KHR_materials_volume_scatter", json::object()},
                                          {"ACME_glow", json::object()}}}});
  EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::blend);
  EXPECT_EQ(scene.materials[0].notModelled, (std::vector<std::string>{"subsurface", "volume scatter"}));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "material 'paint': not modelled: subsurface, volume scatter");
}

TEST(GltfMaterial, ListsUnsupportedExtensionsOnce) {
  GltfFile file = makeQuad();
  file.json["extensionsUsed"] = {"ACME_y", "KHR_materials_ior", "KHR_materials_subsurface", "ACME_y", "ACME_x"};
  file.json["extensionsRequired"] = {"KHR_materials_subsurface"}; // known not to be modelled: the base layer is shown
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0], "extensions that are not supported are ignored: ACME_y, ACME_x");
}

TEST(GltfMaterial, ReadsAnyTwoUvSets) {
  GltfFile file = makeTextured();
  file.primitive()["attributes"]["TEXCOORD_3"] = file.add<float>({1, 2, 3, 4, 5, 6, 7, 8}, "VEC2");
  file.material() = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}, {"texCoord", 3}}}}},
                     {"normalTexture", {{"index", 1}}}};
  Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.materials[0].baseColorTexture.texCoord, 1);
  EXPECT_EQ(scene.materials[0].normalTexture.texCoord, 0);
  EXPECT_EQ(scene.meshes[0].uv1[3], glm::vec2(7, 8));
  EXPECT_TRUE(scene.warnings.empty());
  // A third set has no place: its texture is left out, and the material says so.
  file.material()["emissiveFactor"] = {1, 1, 1};
  file.material()["emissiveTexture"] = {{"index", 1}, {"texCoord", 5}};
  scene = loadQuadlike(file);
  EXPECT_FALSE(scene.materials[0].emissiveTexture.present());
  EXPECT_EQ(scene.materials[0].notModelled,
            std::vector<std::string>{"a texture uses TEXCOORD_5, a third uv set; at most two are supported"});
  EXPECT_TRUE(scene.materials[0].baseColorTexture.present());
}

TEST(GltfTexture, ReadsSlotsSamplersAndOnlyTheImagesInUse) {
  GltfFile file = makeTextured();
  file.primitive()["attributes"]["TEXCOORD_1"] = file.primitive()["attributes"]["TEXCOORD_0"];
  file.material() = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}, {"texCoord", 1}}}}},
                     {"normalTexture", {{"index", 1}, {"scale", 0.5}}}};
  const Scene scene = loadQuadlike(file);
  ASSERT_EQ(scene.images.size(), 1u) << "image 0 is not used";
  EXPECT_EQ(scene.images[0].pixels.width, 5);
  EXPECT_EQ(scene.images[0].pixels.channels, 4);
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.baseColorTexture.image, 0);
  EXPECT_EQ(material.baseColorTexture.texCoord, 1);
  EXPECT_EQ(material.baseColorTexture.sampler.wrapU, Wrap::clampToEdge);
  EXPECT_EQ(material.baseColorTexture.sampler.wrapV, Wrap::mirroredRepeat);
  EXPECT_EQ(material.baseColorTexture.sampler.magFilter, Filter::nearest);
  EXPECT_FALSE(material.baseColorTexture.sampler.useMips);
  EXPECT_EQ(material.normalScale, 0.5f);
  EXPECT_FALSE(scene.meshes[0].tangents.empty()) << "a normal map needs them";
}

TEST(GltfTexture, ReadsEveryFilterOfTheSpecification) {
  struct Case {
    int value;
    Filter min, mip;
    bool useMips;
  };
  for (const Case& expected :
       {Case{9728, Filter::nearest, Filter::nearest, false}, Case{9729, Filter::linear, Filter::nearest, false},
        Case{9984, Filter::nearest, Filter::nearest, true}, Case{9985, Filter::linear, Filter::nearest, true},
        Case{9986, Filter::nearest, Filter::linear, true}, Case{9987, Filter::linear, Filter::linear, true}}) {
    GltfFile file = makeTextured();
    file.json["samplers"][0]["minFilter"] = expected.value;
    file.material() = {{"occlusionTexture", {{"index", 1}}}};
    const scenes::Sampler sampler = loadQuadlike(file).materials[0].occlusionTexture.sampler;
    EXPECT_EQ(sampler.minFilter, expected.min) << expected.value;
    EXPECT_EQ(sampler.mipFilter, expected.mip) << expected.value;
    EXPECT_EQ(sampler.useMips, expected.useMips) << expected.value;
  }
}

TEST(GltfTexture, ReadsTheTextureTransformAndItsTexCoordOverride) {
  GltfFile file = makeTextured();
  file.primitive()["attributes"]["TEXCOORD_1"] = file.primitive()["attributes"]["TEXCOORD_0"];
  const json transform = {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"texCoord", 1}};
  file.material() = {
      {"emissiveFactor", {1, 1, 1}},
      {"emissiveTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}},
      {"pbrMetallicRoughness", {{"metallicFactor", 0.5}}},
      {"extensions",
       {{"KHR_materials_specular",
         {{"specularTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}}}}}};
  const Material material = loadQuadlike(file).materials[0];
  const std::array<float, 6> expected = {2, 0, 0.25f, 0, 3, 0.5f};
  EXPECT_EQ(material.emissiveTexture.uvTransform, expected);
  EXPECT_EQ(material.emissiveTexture.texCoord, 1);
  EXPECT_EQ(material.specularTexture.uvTransform, expected);
}

// The Khronos asset TextureTransformTest: an arrow from the image's top left along its diagonal must point to the green
// marker at (-0.0790, -0.5163) on a quad whose uv is (x + 0.5, 0.5 - y), for a rotation of 22.5 degrees.
TEST(GltfTexture, RotatesAsTheKhronosTestAssetNeedsIt) {
  const auto m = scenes::uvTransform({0, 0}, 0.39269908169872414, {1, 1});
  const double u = -0.07904822439840126 + 0.5, v = 0.5 + 0.5162674857624154;
  const double sampledU = m[0] * u + m[1] * v + m[2], sampledV = m[3] * u + m[4] * v + m[5];
  EXPECT_NEAR(sampledU, sampledV, 1e-6) << "on the diagonal";
  EXPECT_GT(sampledU, 0.5);
  // "All": offset (-0.2, -0.1), rotation 0.3, scale 1.5, marker at (-0.07, -0.25): near the tip at (0.69, 0.69).
  const auto all = scenes::uvTransform({-0.2, -0.1}, 0.3, {1.5, 1.5});
  EXPECT_NEAR(all[0] * 0.43 + all[1] * 0.75 + all[2], 0.75, 0.06);
  EXPECT_NEAR(all[3] * 0.43 + all[4] * 0.75 + all[5], 0.75, 0.06);
}

TEST(GltfTexture, LeavesOutTexturesThatCannotChangeTheColor) {
  GltfFile file = makeTextured();
  file.material() = {{"emissiveTexture", {{"index", 0}}}, // emissiveFactor is 0
                     {"occlusionTexture", {{"index", 0}, {"strength", 0}}},
                     {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}};
  Scene scene = loadQuadlike(file);
  EXPECT_EQ(scene.images.size(), 1u);
  EXPECT_FALSE(scene.materials[0].emissiveTexture.present());
  EXPECT_FALSE(scene.materials[0].occlusionTexture.present());
  EXPECT_TRUE(scene.materials[0].baseColorTexture.present());
  file.material() = {{"normalTexture", {{"index", 0}}},
                     {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}},
                     {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  scene = loadQuadlike(file);
  EXPECT_FALSE(scene.materials[0].normalTexture.present()) << "unlit";
  EXPECT_TRUE(scene.materials[0].baseColorTexture.present());
}

TEST(GltfTexture, WarnsWhereAMeshLacksTheUvThatATextureReads) {
  GltfFile file = makeTextured();
  file.material() = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}, {"texCoord", 1}}}}}};
  EXPECT_TRUE(hasWarning(loadQuadlike(file).warnings, "needs TEXCOORD_1, which the mesh lacks"));
}

TEST(GltfTexture, ReadsImagesFromFilesDataUrisAndPercentEncodedNames) {
  const TempFolder folder;
  GltfFile file = makeQuad();
  std::filesystem::create_directories(folder / "maps");
  writeFile(folder / "maps/my picture.png", makePng(3, 3));
  file.json["images"] = {{{"uri", "maps/my%20picture.png"}},
                         {{"uri", "data:image/png;base64," + encodeBase64(makePng(6, 2))}}};
  file.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  file.material() = {{"occlusionTexture", {{"index", 0}}}, {"normalTexture", {{"index", 1}}}};
  const Scene scene = scenes::loadScene(writeExternal(folder, file));
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_EQ(scene.images[0].pixels.width, 3);
  EXPECT_EQ(scene.images[1].pixels.width, 6);
  EXPECT_EQ(scene.images[0].pixels.pixels[0], 128);
}

} // namespace
} // namespace parity::tests
