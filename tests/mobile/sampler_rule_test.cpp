// How many samplers a material takes on mobile, and what is said of one that takes too many.
#include <gtest/gtest.h>

#include "mobile/sampler_rule.h"

namespace parity::mobile {
namespace {

// All seven slots, each with an image of its own.
scenes::Material makeFull() {
  scenes::Material m;
  m.name = "full";
  int image = 0;
  for (scenes::TextureSlot* slot :
       {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture, &m.occlusionTexture, &m.emissiveTexture,
        &m.specularTexture, &m.specularColorTexture})
    slot->image = image++;
  return m;
}

TEST(SamplerRule, CountsTheEnvironmentWhereItIsFetched) {
  scenes::Material m = makeFull();
  EXPECT_EQ(countSamplers(m, {.environment = false}), 7u);
  EXPECT_EQ(countSamplers(m, {.environment = true}), 8u);
  m.fullyRough = true;
  EXPECT_EQ(countSamplers(m, {.environment = true}), 7u);
}

TEST(SamplerRule, CountsBakedLightForAllButUnlitMaterials) {
  scenes::Material m = makeFull();
  EXPECT_EQ(countSamplers(m, {.environment = true, .lightmap = true}), 9u);
  EXPECT_EQ(countSamplers(m, {.environment = true, .lightmap = true, .sunShadow = true}), 10u);
  EXPECT_EQ(describeExcess(m, {.environment = true, .lightmap = true}),
            "needs 9 samplers on mobile, expected at most 8");
  m.fullyRough = true;
  EXPECT_EQ(countSamplers(m, {.environment = true, .lightmap = true, .sunShadow = true}), 9u);
  m.unlit = true;
  EXPECT_EQ(countSamplers(m, {.lightmap = true, .sunShadow = true}), 1u);
}

TEST(SamplerRule, CountsAPairOfImageAndSamplerOnce) {
  scenes::Material m = makeFull();
  m.occlusionTexture.image = m.metallicRoughnessTexture.image; // as glTF packs them
  EXPECT_EQ(countSamplers(m, {}), 6u);
  m.occlusionTexture.sampler.wrapU = scenes::Wrap::clampToEdge;
  EXPECT_EQ(countSamplers(m, {}), 7u) << "another sampler";
  m.occlusionTexture.sampler = {};
  m.emissiveTexture.image = m.metallicRoughnessTexture.image;
  EXPECT_EQ(countSamplers(m, {}), 6u) << "as colour it is another view of the image";
  m.emissiveTexture.image = m.baseColorTexture.image;
  EXPECT_EQ(countSamplers(m, {}), 5u);
}

// Of further lobes only what the preset reads counts.
TEST(SamplerRule, TexturesOfLayersCountWhereThePresetReadsThem) {
  scenes::Material m;
  m.coat = 1;
  m.sheenColor = glm::vec3(1);
  int image = 0;
  for (scenes::TextureSlot* slot :
       {&m.coatTexture, &m.coatRoughnessTexture, &m.coatNormalTexture, &m.sheenColorTexture, &m.sheenRoughnessTexture})
    slot->image = image++;
  EXPECT_EQ(countSamplers(m, {}), 0u);
  EXPECT_EQ(countSamplers(m, {.coat = true}), 2u) << "the base's normal stands for the coat's";
  EXPECT_EQ(countSamplers(m, {.coat = true, .coatNormal = true}), 3u);
  EXPECT_EQ(countSamplers(m, {.sheen = true}), 2u);
  EXPECT_EQ(countSamplers(m, {.coat = true, .sheen = true, .coatNormal = true}), 5u);
  m.anisotropy = m.iridescence = 1;
  for (scenes::TextureSlot* slot : {&m.anisotropyTexture, &m.iridescenceTexture, &m.iridescenceThicknessTexture})
    slot->image = image++;
  EXPECT_EQ(countSamplers(m, {}), 0u);
  EXPECT_EQ(countSamplers(m, {.anisotropy = true}), 1u);
  EXPECT_EQ(countSamplers(m, {.iridescence = true}), 2u);
  const SamplerInputs all{.coat = true, .sheen = true, .anisotropy = true, .iridescence = true, .coatNormal = true};
  EXPECT_EQ(countSamplers(m, all), 8u);
  m.fullyRough = true;
  EXPECT_EQ(countSamplers(m, all), 0u);
}

TEST(SamplerRule, ANormalMapWithItsSpreadIsAViewOfItsOwn) {
  scenes::Material m = makeFull();
  m.normalTexture.image = m.occlusionTexture.image;
  EXPECT_EQ(countSamplers(m, {.normalVariance = false}), 6u);
  EXPECT_EQ(countSamplers(m, {.normalVariance = true}), 7u);
}

TEST(SamplerRule, AnUnlitMaterialReadsItsColourAlone) {
  scenes::Material m = makeFull();
  m.unlit = true;
  EXPECT_EQ(countSamplers(m, {.environment = true}), 1u);
}

TEST(SamplerRule, SaysWhichMaterialExceedsTheLimit) {
  const SamplerInputs inputs{.environment = true};
  EXPECT_EQ(describeExcess(makeFull(), inputs), "") << "8 are allowed";
  EXPECT_EQ(describeExcess(scenes::Material{}, inputs, 7), "");
  EXPECT_EQ(describeExcess(makeFull(), inputs, 7), "needs 8 samplers on mobile, expected at most 7");
}

} // namespace
} // namespace parity::mobile
