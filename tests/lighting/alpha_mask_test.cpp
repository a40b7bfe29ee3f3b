// Holes of masked materials, by rays and by hand.
#include <gtest/gtest.h>

#include <array>
#include <functional>

#include "lighting/surface/alpha_mask.h"
#include "lighting/surface/visibility.h"
#include "support/small_scenes.h"

namespace parity::lighting {
namespace {

// The quad of tests/support, uv (0,0) at its lower left, with a 4 x 2 texture of these alphas.
scenes::Scene makeMaskedQuad(const std::array<std::uint8_t, 8>& alphas) {
  scenes::Scene scene = tests::makeQuadScene();
  scenes::TextureImage& image = scene.images.emplace_back();
  image.pixels = base::Image8(4, 2, 4, 255);
  for (std::size_t i = 0; i < alphas.size(); ++i) image.pixels.pixels[4 * i + 3] = alphas[i];
  scenes::Material& material = scene.materials[0];
  material.alphaMode = scenes::AlphaMode::mask;
  material.alphaCutoff = 0.5f;
  material.baseColorTexture.image = 0;
  material.baseColorTexture.sampler.magFilter = scenes::Filter::nearest;
  return scene;
}
constexpr std::array<std::uint8_t, 8> kPattern = {255, 0, 255, 0, 0, 0, 255, 255};

bool isHoleAt(const scenes::Scene& scene, double u, double v) {
  return !Visibility(scene).isOccluded({2 * u - 1, 2 * v - 1, 1}, {0, 0, -1});
}

TEST(AlphaMask, RaysPassTheTexelsBelowTheCutoff) {
  const scenes::Scene scene = makeMaskedQuad(kPattern);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      for (const double inTexel : {0.1, 0.4, 0.9})
        EXPECT_EQ(isHoleAt(scene, (x + inTexel) / 4, (y + inTexel) / 2), kPattern[y * 4 + x] == 0) << x << ' ' << y;
}

// Each wrap mode against its definition on infinite rows of texels.
TEST(AlphaMask, UvTransformAndWrapModesAreObeyed) {
  scenes::Scene scene = makeMaskedQuad(kPattern);
  scenes::TextureSlot& slot = scene.materials[0].baseColorTexture;
  slot.uvTransform = {5, 0, -2, 0, 3, -1}; // columns -8..11, rows -2..3
  const auto columnOf = [](int x, scenes::Wrap wrap) {
    constexpr int kMirrored[] = {0, 1, 2, 3, 3, 2, 1, 0};
    return wrap == scenes::Wrap::repeat           ? ((x % 4) + 4) % 4
           : wrap == scenes::Wrap::mirroredRepeat ? kMirrored[((x % 8) + 8) % 8]
                                                  : std::clamp(x, 0, 3);
  };
  for (const scenes::Wrap wrap : {scenes::Wrap::repeat, scenes::Wrap::mirroredRepeat, scenes::Wrap::clampToEdge}) {
    slot.sampler.wrapU = wrap;
    slot.sampler.wrapV = scenes::Wrap::clampToEdge;
    for (int y = -2; y < 4; ++y)
      for (int x = -8; x < 12; ++x)
        EXPECT_EQ(isHoleAt(scene, (x + 0.5 + 8) / 20, (y + 0.5 + 2) / 6),
                  kPattern[std::clamp(y, 0, 1) * 4 + columnOf(x, wrap)] == 0)
            << "wrap " << static_cast<int>(wrap) << " at " << x << ' ' << y;
  }
}

TEST(AlphaMask, LinearFilterPutsTheEdgeWhereAlphaCrossesTheCutoff) {
  scenes::Scene scene = makeMaskedQuad({0, 0, 255, 255, 0, 0, 255, 255}); // 0 at u = 3/8, 1 at 5/8
  scenes::Material& material = scene.materials[0];
  material.baseColorTexture.sampler.magFilter = scenes::Filter::linear;
  for (const float cutoff : {0.2f, 0.5f, 0.8f}) {
    material.alphaCutoff = cutoff;
    const double edge = 0.375 + 0.25 * cutoff;
    EXPECT_TRUE(isHoleAt(scene, edge - 0.002, 0.5));
    EXPECT_FALSE(isHoleAt(scene, edge + 0.002, 0.5));
  }
}

TEST(AlphaMask, MaterialAndVertexAlphaMultiplyTheTextures) {
  scenes::Scene scene = makeMaskedQuad({255, 255, 255, 255, 255, 255, 255, 255});
  scene.meshes[0].colors = {{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0}}; // alpha = u
  scene.materials[0].baseColor.a = 0.8f;                                             // 0.5 at u = 0.625
  EXPECT_TRUE(isHoleAt(scene, 0.62, 0.3));
  EXPECT_FALSE(isHoleAt(scene, 0.63, 0.3));
  scene.materials[0].baseColorTexture.image = -1;
  EXPECT_TRUE(isHoleAt(scene, 0.62, 0.8));
  EXPECT_FALSE(isHoleAt(scene, 0.63, 0.8));
}

TEST(AlphaMask, SecondUvSetIsReadWhereTheSlotSaysSoAndNoUvIsZero) {
  scenes::Scene scene = makeMaskedQuad({0, 255, 255, 255, 255, 255, 255, 255});
  scene.meshes[0].uv1.assign(4, glm::vec2(0.9f));
  EXPECT_TRUE(isHoleAt(scene, 0.1, 0.1));
  scene.materials[0].baseColorTexture.texCoord = 1;
  EXPECT_FALSE(isHoleAt(scene, 0.1, 0.1));
  scene.meshes[0].uv1.clear();
  EXPECT_TRUE(isHoleAt(scene, 0.9, 0.9)) << "the texel at (0, 0)";
}

TEST(AlphaMask, UvsBeyondAllBoundsReadSomeTexel) {
  scenes::Scene scene = makeMaskedQuad(kPattern);
  for (const float huge : {1e30f, -1e30f, 3e38f, std::numeric_limits<float>::quiet_NaN()}) {
    scene.materials[0].baseColorTexture.uvTransform = {huge, 0, huge, 0, huge, huge};
    for (const scenes::Wrap wrap : {scenes::Wrap::repeat, scenes::Wrap::mirroredRepeat, scenes::Wrap::clampToEdge}) {
      scene.materials[0].baseColorTexture.sampler.wrapU = wrap;
      isHoleAt(scene, 0.7, 0.2); // under the sanitizers: no access out of bounds
    }
  }
  scene.materials[0].baseColorTexture.uvTransform = {NAN, 0, 0, 0, NAN, 0};
  EXPECT_FALSE(isHoleAt(scene, 0.3, 0.3)) << "the texel at (0, 0), which is opaque";
}

} // namespace
} // namespace parity::lighting
