// Where captures stand, in rooms whose walls are known.
#include "bake/light/capture_places.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "scenes/builtin/builtin.h"
#include "scenes/builtin/shapes.h"

namespace parity::bake {
namespace {

scenes::Scene makeScene(const std::vector<scenes::Mesh>& meshes) {
  scenes::Scene scene;
  scene.name = "test";
  scene.materials.emplace_back().name = "grey";
  scene.meshes = meshes;
  for (std::uint32_t i = 0; i < meshes.size(); ++i) scene.instances.push_back({i, glm::mat4(1.f), "node"});
  return scene;
}

std::vector<CapturePlace> placesIn(const scenes::Scene& scene, int count) {
  const lighting::Visibility visibility(scene);
  return findCapturePlaces(scene, visibility, count);
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float most) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], most) << "xyz"[c];
}

TEST(CapturePlaces, OfTheRoomStandInItsAirAndTheirBoxIsItsWalls) {
  const scenes::Scene room = scenes::makeBuiltinScene("room");
  for (const CapturePlace& place : placesIn(room, 3)) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_GT(place.position[c] - place.boxLower[c], 0.2f);
      EXPECT_GT(place.boxUpper[c] - place.position[c], 0.2f);
    }
    EXPECT_GT(place.position.x, -1.5f);
    EXPECT_LT(place.position.x, 1.5f);
  }
  const CapturePlace first = placesIn(room, 1).front();
  expectNear(first.boxLower, {-1.5f, 0.f, -2.f}, 0.03f);
  expectNear(first.boxUpper, {1.5f, 2.6f, 2.f}, 0.1f); // the lamp's panel is 6.5 cm below the ceiling
  expectNear(first.position, {0, 1.3f, 0}, 0.6f);
  const scenes::Bounds bounds = room.bounds();
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 corner(i & 1 ? bounds.upper.x : bounds.lower.x, i & 2 ? bounds.upper.y : bounds.lower.y,
                           i & 4 ? bounds.upper.z : bounds.lower.z);
    EXPECT_LE(glm::length(corner - first.position), first.radius * 1.0001f);
  }
}

TEST(CapturePlaces, OfTheCourtyardStandAboveItsGround) {
  const scenes::Scene yard = scenes::makeBuiltinScene("courtyard");
  const std::vector<CapturePlace> places = placesIn(yard, 4);
  ASSERT_EQ(places.size(), 4u);
  for (const CapturePlace& place : places) {
    EXPECT_GT(place.position.y, 0.3f);
    EXPECT_NEAR(place.boxLower.y, 0, 0.5); // or a step's
    EXPECT_LE(place.boxUpper.y, 3.001f);
    EXPECT_LT(std::max(std::abs(place.position.x), std::abs(place.position.z)), 4.f);
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GT(glm::length(places[i].position - places[k].position), 2) << i << " " << k;
}

// The widest room of all is that within the block, which is none.
TEST(CapturePlaces, AreNeverWithinASolid) {
  const scenes::Scene scene = makeScene({scenes::makeBox({-2, 0, -2}, {2, 4, 2}), scenes::makeFloor(3, 1, 1),
                                         scenes::makeBox({2.4, 0, 2.4}, {2.6, 4.2, 2.6})});
  for (const CapturePlace& place : placesIn(scene, 8))
    EXPECT_GT(std::max(std::abs(place.position.x), std::abs(place.position.z)), 2) << place.position.y;
}

// A table between the capture and the floor meets a few rays of the bundle.
TEST(CapturePlaces, BoxIsNotThatOfASmallThingBefore) {
  scenes::Scene scene = makeScene({scenes::makeBox({-0.15, 0.3, -0.15}, {0.15, 0.4, 0.15})});
  scenes::Mesh room = scenes::makeBox({-2, 0, -2}, {2, 3, 2});
  for (std::size_t i = 0; i < room.indices.size(); i += 3) std::swap(room.indices[i], room.indices[i + 1]);
  scene.meshes.push_back(room);
  scene.instances.push_back({1, glm::mat4(1.f), "room"});
  const lighting::Visibility visibility(scene);
  const CapturePlace place = placeCapture(scene, visibility, {0.1f, 1.5f, 0.f});
  expectNear(place.boxLower, {-2, 0, -2}, 1e-3f);
  expectNear(place.boxUpper, {2, 3, 2}, 1e-3f);
}

TEST(CapturePlaces, AreAboveAFlatSceneToo) {
  const std::vector<CapturePlace> places = placesIn(makeScene({scenes::makeFloor(2, 1, 1)}), 2);
  ASSERT_EQ(places.size(), 2u);
  for (const CapturePlace& place : places) {
    EXPECT_GT(place.position.y, 0.1f);
    EXPECT_TRUE(std::isfinite(place.radius));
  }
}

TEST(CapturePlaces, AreTheSameForAnyNumberOfThreads) {
  const scenes::Scene yard = scenes::makeBuiltinScene("courtyard");
  const std::vector<CapturePlace> all = placesIn(yard, 3);
  const base::ThreadLimit one(1);
  const std::vector<CapturePlace> alone = placesIn(yard, 3);
  ASSERT_EQ(all.size(), alone.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].position, alone[i].position);
    EXPECT_EQ(all[i].boxLower, alone[i].boxLower);
    EXPECT_EQ(all[i].boxUpper, alone[i].boxUpper);
    EXPECT_EQ(all[i].radius, alone[i].radius);
  }
}

} // namespace
} // namespace parity::bake
