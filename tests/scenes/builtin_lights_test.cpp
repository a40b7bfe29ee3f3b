// builtin:lights: many lights, of which few reach a point.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "scenes/builtin/builtin.h"

namespace parity::tests {
namespace {

using scenes::Instance;
using scenes::Light;
using scenes::Scene;

struct Ball {
  glm::vec3 center;
  float radius;
};

bool isFloor(const Scene& scene, const Instance& instance) {
  return scene.materials[scene.meshes[instance.mesh].material].name == "floor";
}

std::vector<Ball> ballsOf(const Scene& scene) {
  std::vector<Ball> balls;
  for (const Instance& instance : scene.instances)
    if (!isFloor(scene, instance))
      balls.push_back({glm::vec3(instance.toWorld[3]), glm::length(glm::vec3(instance.toWorld[0]))});
  return balls;
}

struct BuiltinLights : testing::Test {
  const Scene scene = scenes::makeBuiltinScene("lights");
};

TEST_F(BuiltinLights, AreAThousandColouredPointsWithARange) {
  ASSERT_EQ(scene.lights.size(), 1000u);
  std::set<std::string> names;
  std::array<int, 3> strongest{};
  for (const Light& light : scene.lights) {
    EXPECT_EQ(light.kind, scenes::LightKind::point);
    EXPECT_GT(light.range, 0.f);
    EXPECT_TRUE(names.insert(light.name).second) << light.name;
    const glm::vec3 c = light.color;
    const float most = std::max({c.r, c.g, c.b}), least = std::min({c.r, c.g, c.b});
    EXPECT_GT(least, 0.f);
    EXPECT_LT(least, 0.6f * most) << light.name << " is nearly grey";
    ++strongest[c.r == most ? 0 : c.g == most ? 1 : 2];
  }
  for (const int count : strongest) EXPECT_GT(count, 200); // all hues
}

TEST_F(BuiltinLights, ShineOnSpheresOfFewMeshesAndMaterials) {
  EXPECT_EQ(scene.materials.size(), 8u); // the floor's among them
  EXPECT_EQ(scene.meshes.size(), scene.materials.size());
  EXPECT_EQ(ballsOf(scene).size(), 14u * 18u);
  EXPECT_LT(scene.triangleCount(), 300000u);
  std::vector<int> placed(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++placed[instance.mesh];
  EXPECT_GE(*std::min_element(placed.begin(), placed.end()), 30); // no material is rare
}

TEST_F(BuiltinLights, HangOverTheFieldClearOfSpheresAndFloor) {
  const std::vector<Ball> balls = ballsOf(scene);
  for (const Light& light : scene.lights) {
    EXPECT_GE(light.position.y, 0.15f) << light.name;
    EXPECT_LE(light.position.y, 1.2f) << light.name;
    EXPECT_LE(std::abs(light.position.x), 7.f) << light.name;
    EXPECT_LE(std::abs(light.position.z), 9.f) << light.name;
    for (const Ball& ball : balls)
      ASSERT_GT(glm::distance(light.position, ball.center), ball.radius + 0.15f) << light.name;
  }
}

TEST_F(BuiltinLights, SpheresStandApartOnTheFloor) {
  const std::vector<Ball> balls = ballsOf(scene);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_EQ(balls[i].center.y, balls[i].radius);
    for (std::size_t k = 0; k < i; ++k)
      ASSERT_GT(glm::distance(balls[i].center, balls[k].center), balls[i].radius + balls[k].radius + 0.1f);
  }
}

// The mobile path chooses lights object by object: a floor in one piece would have four of a thousand.
TEST_F(BuiltinLights, FloorHasATileUnderEachSphereAndNoOverlaps) {
  std::vector<std::pair<glm::vec2, glm::vec2>> tiles; // lower, upper
  for (const Instance& instance : scene.instances)
    if (isFloor(scene, instance)) {
      const glm::vec2 center(instance.toWorld[3].x, instance.toWorld[3].z), half(0.5f * instance.toWorld[0].x);
      EXPECT_EQ(instance.toWorld[3].y, 0.f);
      for (const auto& [lower, upper] : tiles)
        ASSERT_FALSE(glm::all(glm::lessThan(center - half, upper - 1e-4f)) &&
                     glm::all(glm::greaterThan(center + half, lower + 1e-4f)));
      tiles.emplace_back(center - half, center + half);
    }
  for (const Ball& ball : ballsOf(scene)) {
    const glm::vec2 at(ball.center.x, ball.center.z);
    EXPECT_EQ(std::count_if(tiles.begin(), tiles.end(),
                            [&](const auto& tile) {
                              return glm::all(glm::greaterThan(at - ball.radius, tile.first)) &&
                                     glm::all(glm::lessThan(at + ball.radius, tile.second));
                            }),
              1);
  }
}

TEST_F(BuiltinLights, AboutEightReachAPointOfASphere) {
  double reaching = 0, area = 0;
  std::size_t most = 0;
  for (const Instance& instance : scene.instances) {
    if (isFloor(scene, instance)) continue;
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    for (std::size_t i = 0; i < mesh.positions.size(); i += 7) {
      const auto at = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[i], 1));
      const auto count =
          static_cast<std::size_t>(std::count_if(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
            return glm::distance(light.position, at) < light.range;
          }));
      // Vertices crowd at the poles: each stands for an area in proportion to its distance from the axis.
      const double scale = glm::length(glm::vec3(instance.toWorld[0]));
      const double weight = scale * scale * glm::length(glm::dvec2(mesh.normals[i].x, mesh.normals[i].z));
      reaching += weight * static_cast<double>(count);
      area += weight;
      most = std::max(most, count);
    }
  }
  RecordProperty("reaching", std::to_string(reaching / area));
  EXPECT_GT(reaching / area, 6);
  EXPECT_LT(reaching / area, 10);
  EXPECT_LT(most, 40u); // nowhere a cluster
}

} // namespace
} // namespace parity::tests
