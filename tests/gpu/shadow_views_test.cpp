// What shadow maps look at: all that casts before something, as tightly as can be, and nothing else.
#include "gpu/shadows/shadow_views.h"

#include <gtest/gtest.h>

#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"
#include "base/expect_error.h"
#include "gpu/shadows/shadow_casters.h"
#include "scenes/builtin/shapes.h"
#include "support/small_scenes.h"

namespace parity::gpu {
namespace {

using scenes::LightKind;

scenes::Light makeLight(LightKind kind, const glm::vec3& position, const glm::vec3& direction) {
  scenes::Light light;
  light.kind = kind;
  light.position = position;
  light.direction = glm::normalize(direction);
  light.outerConeAngle = glm::radians(30.f);
  return light;
}
const scenes::Light kSun = makeLight(LightKind::directional, {}, {0.3f, -0.2f, -1.f});

// A floor of 8 m in z = 0 and a ball of 0.5 m that rests on it.
struct FloorAndBall {
  scenes::Scene scene;
  FloorAndBall(float height = 0.5f) {
    scene.name = "floor and ball";
    scene.materials.resize(2);
    scene.meshes = {tests::makeQuad(0), scenes::makeSphere(0.5, 32, 16)};
    scene.meshes[1].material = 1;
    scene.instances = {{0, glm::scale(glm::mat4(1.f), glm::vec3(4, 4, 1)), "floor"},
                       {1, tests::translation(0, 0, height), "ball"}};
  }
};

std::vector<std::uint32_t> castersOf(const scenes::Scene& scene, const scenes::Light& light) {
  const ShadowPlan plan = planShadows(scene, {light}, {});
  return plan.views.empty() ? std::vector<std::uint32_t>() : plan.views[plan.lights[0].first].casters;
}

TEST(ShadowViews, AFloorWithNothingBelowItCastsNone) {
  const FloorAndBall resting, sunk(0.3f);
  EXPECT_EQ(castersOf(resting.scene, kSun), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(castersOf(sunk.scene, kSun), (std::vector<std::uint32_t>{0, 1}));
  const scenes::Light fromBelow = makeLight(LightKind::directional, {}, {0, 0.2f, 1});
  EXPECT_EQ(castersOf(resting.scene, fromBelow), (std::vector<std::uint32_t>{0, 1}));
  // A turned, scaled floor is flat as well.
  FloorAndBall turned;
  for (scenes::Instance& instance : turned.scene.instances)
    instance.toWorld =
        glm::rotate(glm::scale(glm::mat4(1.f), glm::vec3(2, 2, 2)), 0.7f, glm::vec3(1, 2, 0)) * instance.toWorld;
  scenes::Light sun = kSun;
  sun.direction = glm::normalize(glm::mat3(turned.scene.instances[0].toWorld) * glm::vec3(0, 0, -1));
  EXPECT_EQ(castersOf(turned.scene, sun), (std::vector<std::uint32_t>{1}));
}

TEST(ShadowViews, WhatIsBlendedUnlitMostlyTransmissiveEmptyOrNotFiniteCastsNone) {
  FloorAndBall f;
  f.scene.materials[1].alphaMode = scenes::AlphaMode::blend;
  EXPECT_TRUE(castersOf(f.scene, kSun).empty());
  // But it is something that a floor above it is before of.
  f.scene.instances[1].toWorld = tests::translation(0, 0, -1);
  EXPECT_EQ(castersOf(f.scene, kSun), (std::vector<std::uint32_t>{0}));
  FloorAndBall sign;
  sign.scene.materials[1].unlit = true;
  EXPECT_TRUE(castersOf(sign.scene, kSun).empty());
  FloorAndBall glass;
  glass.scene.materials[1].transmission = 0.5f;
  EXPECT_EQ(castersOf(glass.scene, kSun), (std::vector<std::uint32_t>{1}));
  glass.scene.materials[1].transmission = 0.6f;
  EXPECT_TRUE(castersOf(glass.scene, kSun).empty());
  FloorAndBall g;
  g.scene.meshes[1].indices.clear();
  EXPECT_TRUE(castersOf(g.scene, kSun).empty());
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e19f}) {
    FloorAndBall h;
    h.scene.meshes[1].positions[77].x = bad;
    EXPECT_TRUE(castersOf(h.scene, kSun).empty()) << bad;
    // A vertex that no triangle uses is nothing.
    FloorAndBall unused;
    const float extent = planShadows(unused.scene, {kSun}, {}).views[0].extent;
    unused.scene.meshes[1].positions.emplace_back(bad, 0, 0);
    ASSERT_EQ(castersOf(unused.scene, kSun), (std::vector<std::uint32_t>{1})) << bad;
    EXPECT_EQ(planShadows(unused.scene, {kSun}, {}).views[0].extent, extent);
  }
}

TEST(ShadowViews, ADirectionalMapIsTheSmallestSquareAboutItsCasters) {
  // A box of 2 x 2 x 1 m, turned by 30 degrees about the light's axis.
  FloorAndBall f;
  f.scene.meshes[1] = scenes::makeRoundedBox(glm::dvec3(1, 1, 0.5), 0.01, 1);
  f.scene.meshes[1].material = 1;
  f.scene.instances[1].toWorld = glm::rotate(tests::translation(3, 1, 2), glm::radians(30.f), glm::vec3(0, 0, 1));
  const ShadowPlan plan = planShadows(f.scene, {makeLight(LightKind::directional, {}, {0, 0, -1})}, {});
  ASSERT_EQ(plan.views.size(), 1u);
  const ShadowView& view = plan.views[0];
  EXPECT_TRUE(view.orthographic);
  EXPECT_NEAR(view.extent, 1, 0.005);
  EXPECT_NEAR(view.far, 1, 0.01);
  EXPECT_NEAR(view.origin.x, 3, 1e-4);
  EXPECT_NEAR(view.origin.z, 2.5, 0.01);
  EXPECT_EQ(view.side, 2048u);
}

// Every vertex of a caster lies within a map that draws it, between its planes.
TEST(ShadowViews, ContainTheirCasters) {
  FloorAndBall f;
  for (int i = 0; i < 6; ++i)
    f.scene.instances.push_back({1, tests::translation(std::cos(1.f * i) * 3, std::sin(1.f * i) * 3, 0.6f), "ball"});
  scenes::Light wide = makeLight(LightKind::spot, {0, 0, 3}, {0.2f, 0, -1});
  wide.outerConeAngle = 1.5f;
  scenes::Light far = makeLight(LightKind::point, {1, 1, 2}, {0, 0, -1});
  far.range = 50;
  const std::vector<scenes::Light> lights = {kSun, makeLight(LightKind::point, {0.2f, -0.1f, 1.5f}, {0, 0, -1}), wide,
                                             far};
  const ShadowPlan plan = planShadows(f.scene, lights, {});
  for (std::size_t l = 0; l < lights.size(); ++l) {
    std::size_t inside = 0;
    for (std::size_t i = 1; i < f.scene.instances.size(); ++i)
      for (const glm::vec3& position : f.scene.meshes[1].positions) {
        const glm::vec3 p(f.scene.instances[i].toWorld * glm::vec4(position, 1));
        const glm::vec3 fromLight = p - lights[l].position;
        if (lights[l].kind == LightKind::spot &&
            glm::dot(glm::normalize(fromLight), lights[l].direction) < std::cos(wide.outerConeAngle))
          continue;
        bool drawn = false;
        for (std::uint32_t k = 0; k < plan.lights[l].count; ++k) {
          const ShadowView& view = plan.views[plan.lights[l].first + k];
          const glm::vec3 d = p - view.origin;
          const float z = glm::dot(view.forward, d), w = view.orthographic ? 1 : z;
          const bool seen = std::abs(glm::dot(view.right, d)) <= view.extent * w &&
                            std::abs(glm::dot(view.up, d)) <= view.extent * w && z > view.near && z < view.far;
          drawn |= seen && std::count(view.casters.begin(), view.casters.end(), i) == 1;
        }
        EXPECT_TRUE(drawn) << "light " << l << " instance " << i;
        ++inside;
      }
    EXPECT_GT(inside, 1000u);
  }
}

TEST(ShadowViews, LocalLightsDrawWhatTheyReach) {
  FloorAndBall f;
  f.scene.instances.push_back({1, tests::translation(3, 0, 0.5f), "far ball"});
  scenes::Light point = makeLight(LightKind::point, {0, 0, 2}, {});
  point.direction = {0, 0, -1};
  point.range = 2;
  const ShadowPlan plan = planShadows(f.scene, {point}, {});
  ASSERT_EQ(plan.lights[0].count, 1u) << "all that it reaches lies below";
  EXPECT_EQ(plan.views[0].casters, (std::vector<std::uint32_t>{1}));
  EXPECT_NEAR(plan.views[0].forward.z, -1, 1e-6);
  EXPECT_EQ(plan.views[0].side, 1024u);
  // About the ball's box, whose upper corners are a metre below and half a metre aside, both ways.
  EXPECT_NEAR(plan.views[0].extent, 1.02 * std::sqrt(0.5), 1e-5);
  // Between balls it needs a cube, of which faces without casters are empty.
  for (const float x : {-1.5f, 1.5f}) f.scene.instances.push_back({1, tests::translation(x, 0, 2), "beside"});
  const ShadowPlan cube = planShadows(f.scene, {point}, {});
  ASSERT_EQ(cube.lights[0].count, 6u);
  for (const ShadowView& view : cube.views) {
    EXPECT_EQ(view.side, view.casters.empty() ? 0u : 512u);
    EXPECT_EQ(view.casters.empty(), view.forward.z > 0.5f || std::abs(view.forward.y) > 0.5f);
  }
  f.scene.instances.resize(3);
  // Nothing in reach: no map at all.
  point.range = 0.9f;
  EXPECT_EQ(planShadows(f.scene, {point}, {}).lights[0].count, 0u);
}

TEST(ShadowViews, SpotsHaveOneMapUpTo120Degrees) {
  const FloorAndBall f;
  scenes::Light spot = makeLight(LightKind::spot, {0, 0, 1.2f}, {0.1f, 0, -1}); // just above the ball
  spot.outerConeAngle = glm::radians(59.f);
  ShadowPlan plan = planShadows(f.scene, {spot}, {});
  EXPECT_EQ(plan.lights[0].count, 1u);
  EXPECT_EQ(plan.views[0].side, 1024u);
  EXPECT_NEAR(plan.views[0].extent, std::tan(glm::radians(59.f)), 1e-5);
  spot.outerConeAngle = glm::radians(89.f);
  plan = planShadows(f.scene, {spot}, {});
  EXPECT_EQ(plan.lights[0].count, 6u);
  EXPECT_EQ(plan.views[4].side, 0u) << "+z, behind the cone";
  EXPECT_GT(plan.views[5].side, 0u);
}

TEST(ShadowViews, AFarLampIsAimedAtWhatCasts) {
  const FloorAndBall f;
  for (const LightKind kind : {LightKind::point, LightKind::spot}) {
    const scenes::Light lamp = makeLight(kind, {300, 0, 400}, {-3, 0, -4});
    const ShadowPlan plan = planShadows(f.scene, {lamp}, {});
    ASSERT_EQ(plan.lights[0].count, 1u);
    EXPECT_LT(plan.views[0].extent, 1.2f * std::sqrt(0.75f) / 500);
    EXPECT_EQ(plan.views[0].casters, (std::vector<std::uint32_t>{1}));
  }
}

TEST(ShadowViews, EqualLightsShareAndDarkOnesHaveNone) {
  const FloorAndBall f;
  scenes::Light dark = kSun;
  dark.color = glm::vec3(0);
  scenes::Light red = kSun;
  red.color = {5, 0, 0};
  const ShadowPlan plan = planShadows(f.scene, {dark, kSun, red}, {});
  EXPECT_EQ(plan.views.size(), 1u);
  EXPECT_EQ(plan.lights[0].count, 0u);
  EXPECT_EQ(plan.lights[1].count, 1u);
  EXPECT_EQ(plan.lights[2].first, plan.lights[1].first);
  EXPECT_EQ(planShadows(f.scene, {dark}, {}).views.size(), 0u);
}

TEST(ShadowViews, LocalMapsShrinkUntilAllFit) {
  const FloorAndBall f;
  std::vector<scenes::Light> lights = {kSun};
  for (int i = 0; i < 20; ++i) lights.push_back(makeLight(LightKind::point, {0.01f * i, 0, 2}, {0, 0, -1}));
  const auto bytesOf = [](const ShadowPlan& plan) {
    std::uint64_t bytes = 0;
    for (const ShadowView& view : plan.views) bytes += std::uint64_t{view.side} * view.side * 4;
    return bytes;
  };
  const ShadowPlan whole = planShadows(f.scene, lights, {});
  EXPECT_FALSE(whole.shrunk);
  ShadowOptions tight;
  tight.maxBytes = bytesOf(whole) - (1 << 20);
  const ShadowPlan plan = planShadows(f.scene, lights, tight);
  EXPECT_TRUE(plan.shrunk);
  EXPECT_LE(bytesOf(plan), tight.maxBytes);
  EXPECT_EQ(plan.views[0].side, 2048u) << "the sun's stays";
  // Then the sun's.
  tight.maxBytes = 1 << 20;
  const ShadowPlan tiny = planShadows(f.scene, lights, tight);
  EXPECT_LE(bytesOf(tiny), tight.maxBytes);
  EXPECT_LT(tiny.views[0].side, 2048u);
  tight.maxBytes = 1 << 14;
  base::expectError([&] { planShadows(f.scene, lights, tight); },
                    {"floor and ball: shadows: the smallest shadow maps of 21 lights need"});
}

} // namespace
} // namespace parity::gpu
