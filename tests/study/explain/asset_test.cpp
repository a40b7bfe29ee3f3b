// Changes of an asset: what they are, what they make of a material, and in which words.
#include "study/explain/asset.h"

#include <gtest/gtest.h>

namespace parity::explain {
namespace {

AssetChange change(const char* quantity, double factor) { return {quantity, factor, {}, 0}; }

TEST(Asset, ChangesBeginWithTheSmallest) {
  const std::vector<AssetChange> changes = assetChanges();
  ASSERT_FALSE(changes.empty());
  for (std::size_t i = 1; i < changes.size(); ++i)
    EXPECT_GE(std::abs(changes[i].factor - 1), std::abs(changes[i - 1].factor - 1) - 1e-9);
  EXPECT_NEAR(std::abs(changes.back().factor - 1), 0.25, 1e-9);
}

TEST(Asset, ScalesOneQuantity) {
  scenes::Material material;
  material.roughness = 0.5f;
  material.metallic = 0.8f;
  material.baseColor = {0.2f, 0.4f, 0.6f, 0.7f};
  AssetChange rougher = change("roughness", 1.2), bluer = change("base colour", 1.1), less = change("metallic", 0.9);
  EXPECT_FLOAT_EQ(withChange(material, rougher)->roughness, 0.6f);
  EXPECT_NEAR(*rougher.value, 0.6, 1e-6);
  EXPECT_FLOAT_EQ(withChange(material, less)->metallic, 0.72f);
  const scenes::Material brighter = *withChange(material, bluer);
  EXPECT_FLOAT_EQ(brighter.baseColor.z, 0.66f);
  EXPECT_FLOAT_EQ(brighter.baseColor.w, 0.7f) << "opacity is no colour";
  EXPECT_FLOAT_EQ(brighter.roughness, 0.5f);
  EXPECT_EQ(describe(rougher), "roughness 0.6 instead of 0.5");
  EXPECT_EQ(describe(bluer), "base colour times 1.1");
  material.metallicRoughnessTexture.image = 0;
  AssetChange textured = change("roughness", 1.2);
  EXPECT_TRUE(withChange(material, textured));
  EXPECT_EQ(describe(textured), "roughness times 1.2");
}

TEST(Asset, RefusesWhatNoMaterialCanHave) {
  scenes::Material material; // metallic 1, roughness 1, white
  for (const char* quantity : {"roughness", "metallic", "base colour"}) {
    AssetChange more = change(quantity, 1.05), less = change(quantity, 0.95);
    EXPECT_FALSE(withChange(material, more)) << quantity;
    EXPECT_TRUE(withChange(material, less)) << quantity;
  }
  material.metallic = 0;
  material.baseColor = glm::vec4(0, 0, 0, 1);
  AssetChange metallic = change("metallic", 0.9), color = change("base colour", 0.9);
  EXPECT_FALSE(withChange(material, metallic));
  EXPECT_FALSE(withChange(material, color));
}

} // namespace
} // namespace parity::explain
