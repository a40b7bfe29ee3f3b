// How fine lightmaps are by default.
#include "bake/atlas/density.h"

#include <gtest/gtest.h>

#include "bake/bake_scenes.h"

namespace parity::bake {
namespace {

scenes::Scene sceneOf(float half) {
  scenes::Scene scene;
  tests::addObject(scene, tests::square(half), tests::matte("floor", 0.5f));
  return scene;
}

TEST(Density, IsSixteenButOfVerySmallAndLargeScenes) {
  EXPECT_DOUBLE_EQ(defaultTexelsPerMetre(sceneOf(5)), 16);              // 100 m^2: 25,600 texels
  EXPECT_NEAR(defaultTexelsPerMetre(sceneOf(0.01f)), 128 / 0.02, 0.01); // 2 cm: 128 x 128 texels
  EXPECT_NEAR(defaultTexelsPerMetre(sceneOf(500)), 1024 / 1000., 1e-4); // 1 km: 1024 x 1024
  scenes::Scene small = sceneOf(0.01f);
  small.instances[0].toWorld = glm::scale(glm::mat4(1.f), glm::vec3(500)); // 10 m
  EXPECT_DOUBLE_EQ(defaultTexelsPerMetre(small), 16);
  EXPECT_DOUBLE_EQ(defaultTexelsPerMetre({}), 16);
}

} // namespace
} // namespace parity::bake
