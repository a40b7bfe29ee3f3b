// The cards of materials whose values and textures are known.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "job/scene/material_cards.h"

namespace parity::job {
namespace {

using report::CardInput, report::MaterialCard;

// Half of the texels have the one value, half the other.
int addImage(scenes::Scene& scene, const std::string& name, std::array<std::uint8_t, 4> a,
             std::array<std::uint8_t, 4> b) {
  base::Image8 pixels(8, 4, 4);
  for (std::size_t i = 0; i < pixels.pixelCount(); ++i)
    std::copy_n((i % 2 == 0 ? a : b).begin(), 4, &pixels.pixels[4 * i]);
  scene.images.push_back({name, std::move(pixels), name + ".png"});
  return static_cast<int>(scene.images.size()) - 1;
}

scenes::Material& addMaterial(scenes::Scene& scene, const std::string& name) {
  scenes::Material& material = scene.materials.emplace_back();
  material.name = name;
  return material;
}

const CardInput* find(const MaterialCard& card, const std::string& name) {
  const auto found = std::ranges::find(card.inputs, name, &CardInput::name);
  return found == card.inputs.end() ? nullptr : &*found;
}

std::vector<std::string> namesOf(const MaterialCard& card) {
  std::vector<std::string> names;
  for (const CardInput& input : card.inputs) names.push_back(input.name);
  return names;
}

double linearOf(double srgb) { return std::pow((srgb + 0.055) / 1.055, 2.4); }

TEST(MaterialCards, SayPlainValuesAsTheFileHasThem) {
  scenes::Scene scene;
  scenes::Material& m = addMaterial(scene, "paint");
  m.baseColor = {0.8f, 0.2f, 0.1f, 0.7f};
  m.metallic = 0;
  m.roughness = 0.35f;
  m.doubleSided = true;
  const MaterialCards made = describeMaterials(scene, {}, true);
  ASSERT_EQ(made.cards.size(), 1u);
  EXPECT_TRUE(made.pictures.empty());
  const MaterialCard& card = made.cards[0];
  EXPECT_EQ(namesOf(card), (std::vector<std::string>{"baseColor", "metallic", "roughness"}));
  EXPECT_EQ(find(card, "baseColor")->value, (std::vector<double>{0.8, 0.2, 0.1})) << "and not 0.800000011920929";
  EXPECT_EQ(find(card, "roughness")->value, std::vector<double>{0.35});
  EXPECT_FALSE(find(card, "roughness")->texture);
  EXPECT_EQ(card.alphaMode, "opaque");
  EXPECT_FALSE(card.alphaCutoff);
  EXPECT_TRUE(card.doubleSided);
  EXPECT_TRUE(card.nonmetal);
  EXPECT_FALSE(card.unlit || card.fullyRough || card.vertexColors);
}

TEST(MaterialCards, MeasureTexturesTimesTheirFactors) {
  scenes::Scene scene;
  const int color = addImage(scene, "wood", {51, 102, 255, 0}, {153, 102, 0, 255});
  const int packed = addImage(scene, "orm", {0, 51, 255, 255}, {255, 255, 255, 255});
  scenes::Material& m = addMaterial(scene, "wood");
  m.baseColor = {1, 0.5f, 1, 0.5f};
  m.baseColorTexture.image = color;
  m.alphaMode = scenes::AlphaMode::mask;
  m.alphaCutoff = 0.25f;
  m.metallicRoughnessTexture.image = m.occlusionTexture.image = packed;
  m.roughness = 0.5f;
  m.occlusionStrength = 0.5f;
  m.normalTexture.image = addImage(scene, "bumps", {128, 128, 255, 255}, {128, 128, 255, 255});
  m.normalTexture.texCoord = 1;
  m.normalScale = 2;
  const MaterialCard card = describeMaterials(scene, {}, true).cards.at(0);
  EXPECT_EQ(namesOf(card),
            (std::vector<std::string>{"baseColor", "opacity", "metallic", "roughness", "normal", "occlusion"}));
  const report::CardTexture& base = *find(card, "baseColor")->texture;
  EXPECT_EQ(base.name, "wood");
  EXPECT_EQ(base.file, "wood.png");
  EXPECT_EQ(base.channels, "rgb");
  EXPECT_EQ(base.width, 8);
  EXPECT_EQ(base.height, 4);
  EXPECT_DOUBLE_EQ(base.least.at(0), linearOf(0.2));
  EXPECT_DOUBLE_EQ(base.most.at(0), linearOf(0.6));
  EXPECT_DOUBLE_EQ(base.mean.at(0), (linearOf(0.2) + linearOf(0.6)) / 2);
  EXPECT_DOUBLE_EQ(base.least.at(1), 0.5 * linearOf(0.4));
  EXPECT_EQ(base.least.at(1), base.most.at(1));
  EXPECT_EQ(base.least.at(1), base.mean.at(1)) << "one value";
  EXPECT_EQ(base.least.at(2), 0);
  EXPECT_EQ(base.most.at(2), 1);
  const report::CardTexture& opacity = *find(card, "opacity")->texture;
  EXPECT_EQ(opacity.channels, "a");
  EXPECT_EQ(opacity.least, std::vector<double>{0});
  EXPECT_EQ(opacity.most, std::vector<double>{0.5});
  EXPECT_EQ(opacity.mean, std::vector<double>{0.25});
  EXPECT_EQ(card.alphaCutoff, 0.25);
  const report::CardTexture& roughness = *find(card, "roughness")->texture;
  EXPECT_EQ(roughness.least, std::vector<double>{0.1});
  EXPECT_EQ(roughness.most, std::vector<double>{0.5});
  EXPECT_DOUBLE_EQ(roughness.mean.at(0), 0.3);
  EXPECT_EQ(find(card, "metallic")->texture->least, std::vector<double>{1});
  const report::CardTexture& occlusion = *find(card, "occlusion")->texture;
  EXPECT_EQ(occlusion.least, std::vector<double>{0.5}) << "half of the strength leaves half";
  EXPECT_EQ(occlusion.most, std::vector<double>{1});
  const CardInput& normal = *find(card, "normal");
  EXPECT_EQ(normal.value, std::vector<double>{2});
  EXPECT_EQ(normal.texture->texCoord, 1);
  EXPECT_TRUE(normal.texture->mean.empty());
  EXPECT_NE(normal.texture->picture, "");
}

TEST(MaterialCards, WriteEachPictureOnceByItsContent) {
  scenes::Scene scene;
  const int shared = addImage(scene, "shared", {10, 20, 30, 255}, {40, 50, 60, 255});
  const int same = addImage(scene, "same again", {10, 20, 30, 255}, {40, 50, 60, 255});
  const int other = addImage(scene, "other", {11, 20, 30, 255}, {40, 50, 60, 255});
  for (const int image : {shared, shared, same, other})
    addMaterial(scene, std::to_string(scene.materials.size())).baseColorTexture.image = image;
  const MaterialCards made = describeMaterials(scene, {}, true);
  const auto pictureOf = [&](std::size_t i) { return made.cards.at(i).inputs[0].texture->picture; };
  EXPECT_EQ(made.pictures.size(), 2u);
  EXPECT_EQ(pictureOf(0), pictureOf(1));
  EXPECT_EQ(pictureOf(0), pictureOf(2));
  EXPECT_NE(pictureOf(0), pictureOf(3));
  for (const EncodedPicture& picture : made.pictures) {
    ASSERT_TRUE(picture.file.starts_with("images/")) << picture.file;
    EXPECT_TRUE(isCardPicture(picture.file.substr(7))) << picture.file;
  }
  const MaterialCards without = describeMaterials(scene, {}, false);
  EXPECT_TRUE(without.pictures.empty());
  EXPECT_EQ(without.cards[0].inputs[0].texture->picture, "");
  EXPECT_EQ(without.cards[0].inputs[0].texture->mean, made.cards[0].inputs[0].texture->mean);
}

TEST(MaterialCards, AreOfTheMaterialsAskedFor) {
  scenes::Scene scene;
  for (const char* name : {"wood a", "metal", "wood b"}) addMaterial(scene, name);
  const MaterialCards made = describeMaterials(scene, {"wood*"}, true);
  ASSERT_EQ(made.cards.size(), 2u);
  EXPECT_EQ(made.cards[1].name, "wood b");
}

TEST(MaterialCards, OfAnImageThatWasNotDecodedSayItsNameAlone) {
  scenes::Scene scene;
  scene.images.push_back({"far away", {}, "far.png"});
  addMaterial(scene, "hidden").baseColorTexture.image = 0;
  const MaterialCards made = describeMaterials(scene, {}, true);
  const report::CardTexture& texture = *made.cards.at(0).inputs[0].texture;
  EXPECT_EQ(texture.file, "far.png");
  EXPECT_EQ(texture.width, 0);
  EXPECT_TRUE(texture.mean.empty());
  EXPECT_EQ(texture.picture, "");
  EXPECT_TRUE(made.pictures.empty());
}

TEST(MaterialCards, SayWhatIsNotTheDefault) {
  scenes::Scene scene;
  scenes::Material& m = addMaterial(scene, "lamp");
  m.emissive = {0, 2.5f, 5};
  m.specular = 0.5f;
  m.specularColor = {1, 0.5f, 1};
  m.alphaMode = scenes::AlphaMode::blend;
  m.baseColor.w = 0.3f;
  m.unlit = m.fullyRough = true;
  m.notModelled = {"subsurface"};
  scenes::Mesh& mesh = scene.meshes.emplace_back();
  mesh.colors = {glm::vec4(1)};
  const MaterialCard card = describeMaterials(scene, {}, true).cards.at(0);
  EXPECT_EQ(namesOf(card), (std::vector<std::string>{"baseColor", "opacity", "metallic", "roughness", "emissive",
                                                     "specular", "specularColor"}));
  EXPECT_EQ(find(card, "emissive")->value, (std::vector<double>{0, 2.5, 5}));
  EXPECT_EQ(find(card, "opacity")->value, std::vector<double>{0.3});
  EXPECT_EQ(card.alphaMode, "blend");
  EXPECT_TRUE(card.unlit && card.fullyRough && card.vertexColors);
  EXPECT_FALSE(card.nonmetal);
  EXPECT_NEAR(card.f0.at(1), 0.01, 1e-7);
  EXPECT_EQ(card.notModelled, std::vector<std::string>{"subsurface"});
}

TEST(MaterialCards, SayCoatAndSheenWithTheirTextures) {
  scenes::Scene scene;
  const int masks = addImage(scene, "masks", {51, 102, 0, 255}, {255, 204, 0, 51});
  scenes::Material& m = addMaterial(scene, "lacquered velvet");
  m.coat = 0.5f;
  m.coatRoughness = 0.3f;
  m.coatNormalScale = 2;
  m.sheenColor = {0.5f, 0.2f, 1};
  m.sheenRoughness = 0.8f;
  const std::vector<std::string> plain = {"baseColor",     "metallic",   "roughness",     "coat",
                                          "coatRoughness", "sheenColor", "sheenRoughness"};
  EXPECT_EQ(namesOf(describeMaterials(scene, {}, true).cards.at(0)), plain);
  m.coatTexture.image = m.coatRoughnessTexture.image = m.sheenColorTexture.image = m.sheenRoughnessTexture.image =
      masks;
  m.coatNormalTexture.image = addImage(scene, "dents", {128, 128, 255, 255}, {128, 128, 255, 255});
  const MaterialCards made = describeMaterials(scene, {}, true);
  const MaterialCard& card = made.cards.at(0);
  EXPECT_EQ(find(card, "coat")->value, std::vector<double>{0.5});
  EXPECT_EQ(find(card, "coat")->texture->channels, "r");
  EXPECT_EQ(find(card, "coat")->texture->least, std::vector<double>{0.1});
  EXPECT_EQ(find(card, "coatRoughness")->value, std::vector<double>{0.3}) << "as the file has it";
  EXPECT_EQ(find(card, "coatRoughness")->texture->channels, "g");
  EXPECT_DOUBLE_EQ(find(card, "coatRoughness")->texture->most.at(0), 0.3 * 0.8);
  EXPECT_EQ(find(card, "coatNormal")->value, std::vector<double>{2});
  EXPECT_TRUE(find(card, "coatNormal")->texture->mean.empty());
  EXPECT_EQ(find(card, "sheenColor")->texture->channels, "rgb");
  EXPECT_DOUBLE_EQ(find(card, "sheenColor")->texture->least.at(0), 0.5 * linearOf(0.2)) << "sRGB";
  EXPECT_EQ(find(card, "sheenRoughness")->texture->channels, "a");
  EXPECT_DOUBLE_EQ(find(card, "sheenRoughness")->texture->least.at(0), 0.8 * 0.2);
  EXPECT_EQ(made.pictures.size(), 5u) << "one of each choice of channels";
  scene.materials[0].unlit = true;
  EXPECT_EQ(namesOf(describeMaterials(scene, {}, true).cards.at(0)),
            (std::vector<std::string>{"baseColor", "metallic", "roughness"}));
}

TEST(MaterialCards, SayLightThatPassesThroughWithItsTextures) {
  scenes::Scene scene;
  const int texels = addImage(scene, "texels", {51, 102, 0, 255}, {255, 204, 255, 51});
  scenes::Material& m = addMaterial(scene, "stained glass");
  const auto names = [&] { return namesOf(describeMaterials(scene, {}, false).cards.at(0)); };
  const std::vector<std::string> plain = {"baseColor", "metallic", "roughness"};
  m.thickness = 0.5f;
  m.dispersion = 2;
  EXPECT_EQ(names(), plain) << "nothing enters the body";
  m.transmission = 0.75f;
  m.thickness = 0;
  EXPECT_EQ(names(), (std::vector<std::string>{"baseColor", "metallic", "roughness", "transmission"})) << "a thin wall";
  m.thickness = 0.5f;
  m.dispersion = 0;
  EXPECT_EQ(names(),
            (std::vector<std::string>{"baseColor", "metallic", "roughness", "transmission", "ior", "thickness"}));
  m.ior = 1.25f;
  m.dispersion = 2;
  m.attenuationDistance = 0.125f;
  m.attenuationColor = {0.5f, 0.25f, 1};
  m.diffuseTransmission = 0.25f;
  m.diffuseTransmissionColor = {1, 0.5f, 0.25f};
  m.transmissionTexture.image = m.thicknessTexture.image = m.diffuseTransmissionTexture.image =
      m.diffuseTransmissionColorTexture.image = texels;
  const MaterialCards made = describeMaterials(scene, {}, true);
  const MaterialCard& card = made.cards.at(0);
  EXPECT_EQ(namesOf(card),
            (std::vector<std::string>{"baseColor", "metallic", "roughness", "transmission", "diffuseTransmission",
                                      "diffuseTransmissionColor", "ior", "thickness", "attenuationColor",
                                      "attenuationDistance", "dispersion"}));
  EXPECT_EQ(find(card, "transmission")->value, std::vector<double>{0.75});
  EXPECT_EQ(find(card, "transmission")->texture->channels, "r");
  EXPECT_DOUBLE_EQ(find(card, "transmission")->texture->least.at(0), 0.75 * 0.2);
  EXPECT_EQ(find(card, "diffuseTransmission")->value, std::vector<double>{0.25});
  EXPECT_EQ(find(card, "diffuseTransmission")->texture->channels, "a");
  EXPECT_DOUBLE_EQ(find(card, "diffuseTransmission")->texture->least.at(0), 0.25 * 0.2);
  EXPECT_EQ(find(card, "diffuseTransmissionColor")->value, (std::vector<double>{1, 0.5, 0.25}));
  EXPECT_EQ(find(card, "diffuseTransmissionColor")->texture->channels, "rgb");
  EXPECT_DOUBLE_EQ(find(card, "diffuseTransmissionColor")->texture->least.at(0), linearOf(0.2)) << "sRGB";
  EXPECT_EQ(find(card, "ior")->value, std::vector<double>{1.25});
  EXPECT_FALSE(find(card, "ior")->texture);
  EXPECT_EQ(find(card, "thickness")->texture->channels, "g");
  EXPECT_DOUBLE_EQ(find(card, "thickness")->texture->most.at(0), 0.5 * 0.8);
  EXPECT_EQ(find(card, "attenuationColor")->value, (std::vector<double>{0.5, 0.25, 1}));
  EXPECT_EQ(find(card, "attenuationDistance")->value, std::vector<double>{0.125});
  EXPECT_EQ(find(card, "dispersion")->value, std::vector<double>{2});
  EXPECT_EQ(made.pictures.size(), 4u) << "one of each choice of channels";
  m.unlit = true;
  EXPECT_EQ(names(), plain);
}

TEST(MaterialCards, SayAnisotropyAndThinFilmsWithTheirTextures) {
  scenes::Scene scene;
  const int texels = addImage(scene, "texels", {51, 102, 0, 255}, {255, 204, 255, 51});
  scenes::Material& m = addMaterial(scene, "tempered steel");
  m.anisotropy = 0.8f;
  m.anisotropyRotation = 0.25f;
  m.iridescence = 0.5f;
  m.iridescenceIor = 1.7f;
  m.iridescenceThicknessMin = 150;
  m.iridescenceThicknessMax = 650;
  const std::vector<std::string> plain = {
      "baseColor",          "metallic",    "roughness",      "anisotropy",
      "anisotropyRotation", "iridescence", "iridescenceIor", "iridescenceThickness"};
  EXPECT_EQ(namesOf(describeMaterials(scene, {}, true).cards.at(0)), plain);
  m.anisotropyTexture.image = m.iridescenceTexture.image = m.iridescenceThicknessTexture.image = texels;
  const MaterialCards made = describeMaterials(scene, {}, true);
  const MaterialCard& card = made.cards.at(0);
  EXPECT_EQ(namesOf(card), plain);
  EXPECT_EQ(find(card, "anisotropy")->value, std::vector<double>{0.8});
  EXPECT_EQ(find(card, "anisotropy")->texture->channels, "b");
  EXPECT_EQ(find(card, "anisotropy")->texture->most, std::vector<double>{0.8});
  EXPECT_EQ(find(card, "anisotropyRotation")->value, std::vector<double>{0.25});
  EXPECT_EQ(find(card, "anisotropyRotation")->texture->channels, "rgb");
  EXPECT_TRUE(find(card, "anisotropyRotation")->texture->mean.empty()) << "directions have no range";
  EXPECT_EQ(find(card, "iridescence")->texture->channels, "r");
  EXPECT_EQ(find(card, "iridescence")->texture->least, std::vector<double>{0.1});
  EXPECT_EQ(find(card, "iridescenceIor")->value, std::vector<double>{1.7});
  EXPECT_FALSE(find(card, "iridescenceIor")->texture);
  EXPECT_EQ(find(card, "iridescenceThickness")->value, std::vector<double>{650});
  EXPECT_EQ(find(card, "iridescenceThickness")->texture->channels, "g");
  EXPECT_DOUBLE_EQ(find(card, "iridescenceThickness")->texture->least.at(0), 150 + 500 * 0.4);
  EXPECT_DOUBLE_EQ(find(card, "iridescenceThickness")->texture->most.at(0), 150 + 500 * 0.8);
  EXPECT_EQ(made.pictures.size(), 4u) << "one of each choice of channels";
  m.iridescenceThicknessMin = 650;
  m.iridescenceThicknessMax = 150;
  const MaterialCard turned = describeMaterials(scene, {}, false).cards.at(0);
  EXPECT_DOUBLE_EQ(find(turned, "iridescenceThickness")->texture->least.at(0), 650 - 500 * 0.8);
  EXPECT_DOUBLE_EQ(find(turned, "iridescenceThickness")->texture->most.at(0), 650 - 500 * 0.4);
  m.unlit = true;
  EXPECT_EQ(namesOf(describeMaterials(scene, {}, true).cards.at(0)),
            (std::vector<std::string>{"baseColor", "metallic", "roughness"}));
}

TEST(MaterialCards, NamesOfPicturesAreTheirsAlone) {
  EXPECT_TRUE(isCardPicture("texture-0123456789abcdef.png"));
  for (const char* other : {"texture-mine.png", "texture-0123456789abcde.png", "texture-0123456789abcdeg.png",
                            "texture-.png", "0123456789abcdef.png", "texture-0123456789abcdef.jpg", "texture-.pn"})
    EXPECT_FALSE(isCardPicture(other)) << other;
}

} // namespace
} // namespace parity::job
