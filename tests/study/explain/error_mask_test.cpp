// Masks of a texture: where half of the error lies.
#include "study/explain/error_mask.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace parity::explain {
namespace {

int opaque(const base::Image8& mask) {
  int count = 0;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) count += mask.at(x, y)[3] > 0;
  return count;
}

TEST(ErrorMask, MarksTheTexelsThatHoldHalf) {
  // Every texel is seen once; one row has three quarters of the error.
  std::vector<glm::vec2> places;
  std::vector<float> errors;
  for (int y = 0; y < kMaskSide; ++y)
    for (int x = 0; x < kMaskSide; ++x) {
      places.emplace_back((static_cast<float>(x) + 0.5f) / kMaskSide, (static_cast<float>(y) + 0.5f) / kMaskSide);
      errors.push_back(y == 5 ? 3.f * (kMaskSide - 1) : 1.f);
    }
  const TexelMask mask = maskOf(places, errors, {}, 512, 512);
  ASSERT_EQ(mask.picture.width, kMaskSide);
  EXPECT_EQ(opaque(mask.picture), (2 * kMaskSide + 2) / 3) << "two thirds of the row hold half of all";
  for (int x = 0; x < kMaskSide; ++x) EXPECT_EQ(mask.picture.at(x, 4)[3], 0);
  EXPECT_NEAR(mask.texels, (2 * kMaskSide + 2) / 3 / static_cast<double>(kMaskSide * kMaskSide), 1e-12);
}

TEST(ErrorMask, RepeatsAndKeepsTheShapeOfTheTexture) {
  const std::vector<glm::vec2> places = {{0.1f, 0.9f}, {-2.9f, 3.9f}, {0.6f, 0.1f}};
  const TexelMask mask = maskOf(places, std::vector{1.f, 1.f, 1.5f}, {}, 1024, 256);
  EXPECT_EQ(mask.picture.width, kMaskSide);
  EXPECT_EQ(mask.picture.height, kMaskSide / 4);
  EXPECT_EQ(opaque(mask.picture), 1);
  EXPECT_GT(mask.picture.at(3, 7)[3], 0) << "both repeats are one place";
  EXPECT_NEAR(mask.texels, 0.5, 1e-12);
}

TEST(ErrorMask, GoesOnBeyondTheTextureAsTheSamplerDoes) {
  const std::vector<glm::vec2> places = {{1.1f, 1.0f}};
  const auto markedAt = [&](scenes::Wrap wrap, int x, int y) {
    scenes::Sampler sampler;
    sampler.wrapU = sampler.wrapV = wrap;
    return maskOf(places, std::vector{1.f}, sampler, kMaskSide, kMaskSide).picture.at(x, y)[3] > 0;
  };
  EXPECT_TRUE(markedAt(scenes::Wrap::repeat, kMaskSide / 10, 0));
  EXPECT_TRUE(markedAt(scenes::Wrap::clampToEdge, kMaskSide - 1, kMaskSide - 1));
  EXPECT_TRUE(markedAt(scenes::Wrap::mirroredRepeat, kMaskSide * 9 / 10, kMaskSide - 1));
}

TEST(ErrorMask, MarksNothingWithoutErrorAndSurvivesPlacesThatAreNoNumbers) {
  EXPECT_EQ(opaque(maskOf(std::vector<glm::vec2>{{0, 0}}, std::vector{0.f}, {}, 8, 8).picture), 0);
  EXPECT_EQ(maskOf({}, {}, {}, 8, 8).texels, 0);
  const float none = std::numeric_limits<float>::quiet_NaN(), all = std::numeric_limits<float>::infinity();
  EXPECT_EQ(opaque(maskOf(std::vector<glm::vec2>{{none, all}, {-all, 1e30f}}, std::vector{1.f, 1.f}, {}, 0, 0).picture),
            1);
}

TEST(ErrorMask, LiesOverRoughnessBeforeColourBeforeNormals) {
  scenes::Material material;
  EXPECT_EQ(maskedTexture(material).slot, nullptr);
  material.normalTexture.image = 0;
  EXPECT_STREQ(maskedTexture(material).input, "normal");
  material.baseColorTexture.image = 1;
  EXPECT_STREQ(maskedTexture(material).input, "baseColor");
  material.metallicRoughnessTexture.image = 2;
  EXPECT_STREQ(maskedTexture(material).input, "roughness");
  EXPECT_EQ(maskedTexture(material).slot, &material.metallicRoughnessTexture);
}

} // namespace
} // namespace parity::explain
