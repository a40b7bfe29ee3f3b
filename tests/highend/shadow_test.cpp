// Shadows whose place follows from similar triangles, and what casts none.
#include "support/device.h"
#include "support/small_scenes.h"

#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/shadow_maps.h"
#include "gpu/surface_pass.h"
#include "highend/renderer.h"
#include "scenes/shapes.h"
#include "shading/terms.h"

namespace parity::highend {
namespace {

using scenes::LightKind;
constexpr std::uint32_t kSize = 128;
constexpr float kFloor = 2; // half its side

scenes::Light makeLight(LightKind kind) {
  scenes::Light light;
  light.kind = kind;
  light.color = glm::vec3(3);
  light.position = {0, 0, 3};
  light.direction = {0, 0, -1};
  light.outerConeAngle = glm::radians(50.f);
  light.innerConeAngle = glm::radians(49.f);
  return light;
}

// A floor in z = 0, and a square of 1 m at z = 1, seen from below the square: by a camera that looks along the floor's
// normal, its near plane under the square.
struct Square {
  scenes::Scene scene;
  scenes::Camera camera = tests::makeFrontCamera(kFloor, 0.5f, true);
  Square() {
    scene.name = "square";
    scene.meshes = {tests::makeQuad(0), tests::makeQuad(1)};
    scene.materials.resize(2);
    scene.materials[0].doubleSided = scene.materials[1].doubleSided = true;
    scene.materials[0].metallic = 0;
    scene.instances = {{0, glm::scale(glm::mat4(1.f), glm::vec3(kFloor, kFloor, 1)), "floor"},
                       {1, glm::scale(tests::translation(0.25f, 0, 1), glm::vec3(0.5f, 0.5f, 1)), "square"}};
    camera.zNear = 0.1f;
  }
};

class ShadowTest : public tests::DeviceTest {
protected:
  // The floor's radiance by local lights and suns, row by row from the top.
  std::vector<double> floor(const scenes::Scene& scene, const scenes::Camera& camera,
                            const std::vector<scenes::Light>& lights, bool shadows,
                            const gpu::ShadowOptions& options = {}, bool cull = true) {
    const gpu::SceneBuffers buffers(device(), scene);
    const gpu::SurfacePass pass(device(), buffers, kSize, kSize);
    const auto surface = std::move(pass.render(camera, {0, kSize}, glm::vec2(0.5f)).front());
    std::optional<gpu::ShadowMaps> maps;
    if (shadows) maps.emplace(device(), buffers, lights, options);
    Inputs inputs;
    inputs.lights = lights;
    inputs.shadows = maps ? &*maps : nullptr;
    inputs.cullLights = cull;
    const Options plain{.diffuse = DiffuseLobe::lambert, .compensation = Compensation::none};
    const Renderer renderer(device(), buffers, pass.binKinds(), inputs, plain);
    m_shaded = renderer.shade(surface, camera);
    if (maps) m_mapCount = maps->mapCount();
    if (maps) m_drawCount = maps->drawCount();
    std::vector<double> picture(kSize * kSize, -1);
    for (std::size_t i = 0; i < surface.size(); ++i)
      if (surface.instances[i] == 0) picture[surface.pixels[i]] = m_shaded.color[i].x;
    return picture;
  }
  static glm::vec2 placeOf(std::size_t pixel) {
    const float x = static_cast<float>(pixel % kSize) + 0.5f, y = static_cast<float>(pixel / kSize) + 0.5f;
    return glm::vec2(x / kSize * 2 - 1, 1 - y / kSize * 2) * kFloor;
  }
  // inShadow of a place on the floor, given a margin in metres that the shadow is to be grown by.
  template <typename InShadow> void expectShadow(const scenes::Light& light, float texel, const InShadow& inShadow) {
    const Square s;
    const std::vector<double> open = floor(s.scene, s.camera, {light}, false),
                              shadowed = floor(s.scene, s.camera, {light}, true);
    int dark = 0, lit = 0;
    for (std::size_t p = 0; p < open.size(); ++p) {
      const glm::vec2 place = placeOf(p);
      if (open[p] <= 0) continue;
      if (inShadow(place, -2 * texel)) {
        EXPECT_EQ(shadowed[p], 0) << place.x << " " << place.y;
        ++dark;
      } else if (!inShadow(place, 2 * texel)) {
        EXPECT_EQ(shadowed[p], open[p]) << place.x << " " << place.y;
        ++lit;
      }
    }
    EXPECT_GT(dark, 300);
    EXPECT_GT(lit, 3000);
    EXPECT_EQ(m_mapCount, 1u);
    EXPECT_EQ(m_drawCount, 1u) << "the square, not the floor";
  }

  gpu::ShadedSurface m_shaded;
  std::size_t m_mapCount = 0, m_drawCount = 0;
};

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

// The near plane is the lamp's own matter, however far the farthest caster of the scene.
TEST_F(ShadowTest, AHousingCastsUnderADomeOfKilometres) {
  Square s;
  s.scene.meshes[1] = scenes::makeSphere(0.05, 32, 16);
  s.scene.meshes.push_back(scenes::makeSphere(2000, 32, 16));
  for (std::size_t m = 1; m < 3; ++m) s.scene.meshes[m].material = 1;
  s.scene.instances[1].toWorld = tests::translation(0, 0, 1);
  s.scene.instances.push_back({2, glm::mat4(1.f), "dome"});
  scenes::Light lamp = makeLight(LightKind::point);
  lamp.position = {0.01f, 0.01f, 1};
  for (const double value : floor(s.scene, s.camera, {lamp}, true)) EXPECT_EQ(value, 0);
  lamp.position = {0, 0, 0.5f};
  for (const double value : floor(s.scene, s.camera, {lamp}, true)) EXPECT_GT(value, 0);
}

// A caster a kilometre away does not coarsen what is seen; the same maps serve a view of all again.
TEST_F(ShadowTest, OfALargeSceneAreFittedToWhatIsSeen) {
  Square s;
  scenes::Light sun = makeLight(LightKind::directional);
  sun.direction = glm::normalize(glm::vec3(0.6f, -0.3f, -1));
  const auto small = floor(s.scene, s.camera, {sun}, true);
  s.scene.meshes.push_back(scenes::makeSphere(1, 16, 8));
  s.scene.meshes[2].material = 1;
  s.scene.instances.push_back({2, tests::translation(1000, 300, 5), "far ball"});
  const auto large = floor(s.scene, s.camera, {sun}, true);
  EXPECT_EQ(m_mapCount, 2u) << "of all casters, then of this view's";
  int edge = 0, dark = 0;
  for (std::size_t p = 0; p < small.size(); ++p) {
    edge += std::abs(small[p] - large[p]) > 0.01;
    dark += large[p] == 0;
  }
  EXPECT_LT(edge, 130) << "about each pixel of the edge";
  EXPECT_GT(dark, 900);
}

TEST_F(ShadowTest, ADarkLightTakesNoShadowFromAnEqualOne) {
  const Square s;
  const scenes::Light sun = makeLight(LightKind::directional);
  scenes::Light dark = sun;
  dark.color = glm::vec3(0);
  const auto alone = floor(s.scene, s.camera, {sun}, true);
  EXPECT_EQ(floor(s.scene, s.camera, {sun, dark}, true), alone);
  EXPECT_EQ(floor(s.scene, s.camera, {dark, sun}, true), alone);
  EXPECT_NE(floor(s.scene, s.camera, {sun}, false), alone);
}

// A flat caster that faces the light: all of its map's depth is margin, and its coordinates are wrong by much of that.
TEST_F(ShadowTest, APanelFarFromTheOriginDoesNotShadowItself) {
  for (const float far : {0.f, 1000.f, 20000.f}) {
    SCOPED_TRACE(far);
    scenes::Scene scene;
    scene.name = "panel";
    scene.meshes = {tests::makeQuad(0)};
    scene.materials.resize(1);
    const glm::mat4 place = glm::rotate(tests::translation(far, 3, far / 2), 0.7f, glm::vec3(1, 0.5f, 0));
    scene.instances = {{0, glm::scale(place, glm::vec3(kFloor * 1.1f)), "panel"},
                       {0, glm::scale(glm::translate(place, glm::vec3(0, 0, -5)), glm::vec3(20)), "floor"}};
    scenes::Camera camera = tests::makeFrontCamera(kFloor, 2, true);
    camera.toWorld = place * camera.toWorld;
    scenes::Light sun = makeLight(LightKind::directional);
    sun.direction = -glm::normalize(glm::vec3(place[2]));
    const auto open = floor(scene, camera, {sun}, false);
    EXPECT_EQ(floor(scene, camera, {sun}, true), open);
    EXPECT_EQ(m_drawCount, 1u);
    EXPECT_GT(*std::min_element(open.begin(), open.end()), 0);
  }
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
    const std::size_t row = kSize / 2;
    double before = 1;
    for (std::size_t x = 0; x < kSize; ++x) {
      const double share = shadowed[row * kSize + x] / open[row * kSize + x];
      if (placeOf(row * kSize + x).x * kHalf / kFloor > 0.2f) break;
      EXPECT_LE(share, before + 1e-6) << "filter " << filter << " column " << x;
      before = share;
      width += share > 0.001 && share < 0.999 ? 2.0 * kHalf / kSize : 0;
    }
    EXPECT_EQ(before, 0);
    EXPECT_NEAR(width / texel, filter, 0.8) << "filter " << filter;
    EXPECT_EQ(width > 0, filter > 0);
  }
}

TEST_F(ShadowTest, CulledAndUnculledAreTheSame) {
  Square s;
  std::vector<scenes::Light> lights;
  for (int i = 0; i < 40; ++i) {
    scenes::Light light = makeLight(i % 3 ? LightKind::point : LightKind::spot);
    light.position = {0.1f * static_cast<float>(i % 7) - 0.3f, 0.1f * static_cast<float>(i / 7) - 0.3f, 1.2f};
    light.range = 2;
    lights.push_back(light);
  }
  floor(s.scene, s.camera, lights, true, {.mapSize = 256}, true);
  const gpu::ShadedSurface culled = std::move(m_shaded);
  floor(s.scene, s.camera, lights, true, {.mapSize = 256}, false);
  ASSERT_EQ(culled.color.size(), m_shaded.color.size());
  EXPECT_EQ(0, std::memcmp(culled.color.data(), m_shaded.color.data(), culled.color.size() * sizeof(glm::vec4)));
  EXPECT_GT(m_mapCount, 40u);
}

TEST_F(ShadowTest, OfAMillionTriangles) {
  Square s;
  s.scene.meshes[1] = scenes::makeSphere(0.5, 1000, 502);
  s.scene.meshes[1].material = 1;
  ASSERT_GT(s.scene.meshes[1].indices.size(), 3'000'000u);
  s.scene.instances[1].toWorld = tests::translation(0, 0, 1);
  const auto shadowed = floor(s.scene, s.camera, {makeLight(LightKind::directional)}, true);
  const auto open = floor(s.scene, s.camera, {makeLight(LightKind::directional)}, false);
  int dark = 0;
  for (std::size_t p = 0; p < open.size(); ++p) {
    const float r = glm::length(placeOf(p));
    if (std::abs(r - 0.5f) < 0.005f) continue;
    EXPECT_EQ(shadowed[p], r < 0.5f ? 0 : open[p]) << r;
    dark += r < 0.5f;
  }
  EXPECT_GT(dark, 500);
}

} // namespace
} // namespace parity::highend
