// Shadows whose place follows from similar triangles, and what casts none.
#include "shadow_fixture.h"

#include "scenes/builtin/shapes.h"

namespace parity::highend {
namespace {

TEST_F(ShadowTest, OfASunLiesAlongIt) {
  scenes::Light sun = makeLight(LightKind::directional);
  sun.direction = glm::normalize(glm::vec3(0.6f, -0.3f, -1));
  const auto inShadow = [](glm::vec2 p, float grown) { // moved by (0.6, -0.3) on the way of 1 m
    return std::abs(p.x - 0.25f - 0.6f) < 0.5f + grown && std::abs(p.y + 0.3f) < 0.5f + grown;
  };
  expectShadow(sun, 1.2f * 2 / 2048, inShadow);
}

// Similar triangles: a light 3 m above the floor, 2 m above the square.
bool inLampShadow(glm::vec2 p, float grown) {
  return std::abs(p.x - 1.5f * 0.25f) < 1.5f * 0.5f + grown && std::abs(p.y) < 1.5f * 0.5f + grown;
}
TEST_F(ShadowTest, OfAPointLightGrowsWithTheDistance) {
  expectShadow(makeLight(LightKind::point), 2 * 3 / 500.f, inLampShadow);
}
TEST_F(ShadowTest, OfASpotIsThatOfAPointLightInItsCone) {
  expectShadow(makeLight(LightKind::spot), 2 * 3 * 1.2f / 1000, inLampShadow);
}
TEST_F(ShadowTest, OfAWideSpotIsThatOfAPointLight) {
  scenes::Light wide = makeLight(LightKind::spot);
  wide.outerConeAngle = glm::radians(85.f);
  expectShadow(wide, 2 * 3 / 500.f, inLampShadow);
}

TEST_F(ShadowTest, LightComesThroughHolesOfAMask) {
  Square s;
  scenes::TextureImage image{"half", base::Image8(2, 2, 4, 255)};
  image.pixels.pixels[3] = image.pixels.pixels[8 + 3] = 0; // the left column is a hole
  s.scene.images.push_back(image);
  s.scene.materials[1].alphaMode = scenes::AlphaMode::mask;
  s.scene.materials[1].baseColorTexture.image = 0;
  s.scene.materials[1].baseColorTexture.sampler.magFilter = scenes::Filter::nearest;
  const scenes::Light sun = makeLight(LightKind::directional);
  const auto open = floor(s.scene, s.camera, {sun}, false), shadowed = floor(s.scene, s.camera, {sun}, true);
  int dark = 0, through = 0;
  for (std::size_t p = 0; p < open.size(); ++p) {
    const glm::vec2 place = placeOf(p) - glm::vec2(0.25f, 0);
    if (std::abs(place.x) > 0.49f || std::abs(place.y) > 0.49f || std::abs(place.x) < 0.01f) continue;
    EXPECT_EQ(shadowed[p], place.x > 0 ? 0 : open[p]);
    ++(place.x > 0 ? dark : through);
  }
  EXPECT_GT(dark, 300);
  EXPECT_GT(through, 300);
}

TEST_F(ShadowTest, WhatIsBlendedCastsNone) {
  Square s;
  s.scene.materials[1].alphaMode = scenes::AlphaMode::blend;
  const scenes::Light sun = makeLight(LightKind::directional);
  EXPECT_EQ(floor(s.scene, s.camera, {sun}, true), floor(s.scene, s.camera, {sun}, false));
  EXPECT_EQ(m_mapCount, 0u);
}

TEST_F(ShadowTest, ALightInsideOfGeometryStaysThere) {
  Square s;
  s.scene.meshes[1] = scenes::makeSphere(0.2, 32, 16);
  s.scene.meshes[1].material = 1;
  s.scene.instances[1].toWorld = tests::translation(0, 0, 1);
  scenes::Light lamp = makeLight(LightKind::point);
  lamp.position = {0.05f, 0.02f, 1};
  for (const double value : floor(s.scene, s.camera, {lamp}, true)) EXPECT_EQ(value, 0);
  EXPECT_EQ(m_mapCount, 6u) << "all round";
  lamp.position = {0, 0, 0.5f}; // outside of it
  for (const double value : floor(s.scene, s.camera, {lamp}, true)) EXPECT_GT(value, 0);
}

TEST_F(ShadowTest, TheSideThatTurnsAwayIsDark) {
  Square s;
  scenes::Light below = makeLight(LightKind::directional);
  below.direction = {0, 0, 1};
  s.scene.meshes[0].normals.assign(4, glm::normalize(glm::vec3(1, 0, -0.2f))); // bent towards the light
  for (const double value : floor(s.scene, s.camera, {below}, true)) EXPECT_EQ(value, 0);
  double sum = 0;
  for (const double value : floor(s.scene, s.camera, {below}, false)) sum += value;
  EXPECT_GT(sum, 0) << "without shadows the bent normals take it";
}

// The edge of a box filter of so many texels is a ramp of that width.
TEST_F(ShadowTest, FiltersWidenTheEdgeByTheirTexels) {
  Square s;
  constexpr float kHalf = 0.4f; // of what is seen
  s.camera.halfHeight = kHalf;
  const scenes::Light sun = makeLight(LightKind::directional);
  for (const std::uint32_t filter : {0u, 1u, 3u, 5u, 7u}) {
    const gpu::ShadowOptions options{.mapSize = 64, .filter = filter};
    const auto open = floor(s.scene, s.camera, {sun}, false), shadowed = floor(s.scene, s.camera, {sun}, true, options);
    // The share of light along a row through the shadow, from the left edge's outside to its middle.
    double width = 0;
    const double texel = 1.002 / (64 - 2 * gpu::shadowGuard(filter, true)); // metres
    const std::size_t row = kShadowedSide / 2;
    double before = 1;
    for (std::size_t x = 0; x < kShadowedSide; ++x) {
      const double share = shadowed[row * kShadowedSide + x] / open[row * kShadowedSide + x];
      if (placeOf(row * kShadowedSide + x).x * kHalf / kFloor > 0.2f) break;
      EXPECT_LE(share, before + 1e-6) << "filter " << filter << " column " << x;
      before = share;
      width += share > 0.001 && share < 0.999 ? 2.0 * kHalf / kShadowedSide : 0;
    }
    EXPECT_EQ(before, 0);
    EXPECT_NEAR(width / texel, filter, 0.8) << "filter " << filter;
    EXPECT_EQ(width > 0, filter > 0);
  }
}

} // namespace
} // namespace parity::highend
