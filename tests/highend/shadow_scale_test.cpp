// Shadows of scenes that are large, far from the origin, of many lights or of many triangles.
#include "shadow_fixture.h"

#include <algorithm>

#include "scenes/builtin/shapes.h"
#include "support/shaded_values.h"

namespace parity::highend {
namespace {

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
  EXPECT_TRUE(tests::haveSameBits(culled.color, m_shaded.color));
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
