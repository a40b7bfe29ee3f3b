// Points on emitting triangles come as often as their density says, and the density is that of their light.
#include "lighting/surface/emitters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/matte_scenes.h"

namespace parity::lighting {
namespace {

using namespace parity::tests;

// Panels of 4, 1 and 1 square metres and of radiance 1, 2 and 6 (the last double-sided and mirrored), and a floor.
scenes::Scene makePanels() {
  scenes::Scene scene;
  addObject(scene, square(2), matte("floor", 0.5f));
  addObject(scene, square(1), matte("large", 0, 1), glm::translate(glm::mat4(1.f), glm::vec3(-5, 1, 0)));
  addObject(scene, square(0.5f), matte("small", 0, 2), glm::translate(glm::mat4(1.f), glm::vec3(0, 1, 0)));
  addObject(scene, square(0.5f), matte("bright", 0, 6),
            glm::scale(glm::translate(glm::mat4(1.f), glm::vec3(5, 1, 0)), glm::vec3(-1, 1, 1)));
  scene.materials[3].doubleSided = true;
  return scene;
}
// Area times radiance over their sum, 12.
constexpr double kShares[] = {0, 4 / 12., 2 / 12., 6 / 12.}, kAreas[] = {16, 4, 1, 1};

TEST(Emitters, AreSampledByTheirPowerAndEvenlyOverTheirArea) {
  const scenes::Scene scene = makePanels();
  const SurfaceLight surfaces(scene);
  const Emitters emitters(scene, surfaces);
  ASSERT_FALSE(emitters.empty());
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  constexpr int kCount = 60000;
  int quarters[4][2][2] = {};
  for (int i = 0; i < kCount; ++i) {
    const double u = uniform(random), v = uniform(random);
    const EmitterSample sample = emitters.sample({u, v});
    const std::uint32_t k = sample.hit.instance;
    ASSERT_TRUE(k >= 1 && k <= 3);
    const glm::dvec3 at = sample.position - glm::dvec3(5 * (static_cast<int>(k) - 2), 1, 0);
    const double half = k == 1 ? 1 : 0.5;
    ASSERT_TRUE(std::abs(at.x) <= half && std::abs(at.z) <= half && std::abs(at.y) < 1e-6);
    ASSERT_NEAR(glm::distance(sample.normal, glm::dvec3(0, 1, 0)), 0, 1e-6);
    ASSERT_NEAR(sample.pdf, kShares[k] / kAreas[k], 1e-6);
    ASSERT_EQ(emitters.pdf(sample.hit), sample.pdf);
    ASSERT_EQ(sample.bothSides, k == 3);
    ++quarters[k][at.x > 0][at.z > 0];
  }
  for (int k = 1; k < 4; ++k)
    for (int q = 0; q < 4; ++q) {
      const double expected = kShares[k] / 4 * kCount;
      EXPECT_NEAR(quarters[k][q / 2][q % 2], expected, 5 * std::sqrt(expected)) << "panel " << k << ", quarter " << q;
    }
  EXPECT_EQ(emitters.pdf({.instance = 0}), 0);
}

TEST(Emitters, AtTheEndsOfTheirRangeGiveTrianglesThatEmit) {
  const scenes::Scene scene = makePanels();
  const SurfaceLight surfaces(scene);
  const Emitters emitters(scene, surfaces);
  EXPECT_EQ(emitters.sample({1e-12, 0.5}).hit.instance, 1u);
  EXPECT_EQ(emitters.sample({1 - 1e-12, 0.5}).hit.instance, 3u);
}

TEST(Emitters, AreNoneWithoutPower) {
  scenes::Scene scene;
  addObject(scene, square(2), matte("floor", 0.5f));
  addObject(scene, square(0), matte("point", 0, 5));
  addObject(scene, square(1), matte("glass", 0, 5));
  scene.materials[2].alphaMode = scenes::AlphaMode::blend;
  const SurfaceLight surfaces(scene);
  EXPECT_TRUE(Emitters(scene, surfaces).empty());
}

} // namespace
} // namespace parity::lighting
