// Directions come as often as their density says, and all that are above some point come.
#include "bake/light/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "reference/sampling.h"

namespace parity::bake {
namespace {

constexpr std::uint32_t kCount = 1 << 16;

glm::dvec3 evenDirection(std::uint32_t i) {
  const glm::dvec2 u = reference::sobolPoint(i, 5);
  const double y = 2 * u.x - 1, r = std::sqrt(1 - y * y), phi = 2 * std::numbers::pi * u.y;
  return {r * std::cos(phi), y, r * std::sin(phi)};
}

struct Case {
  std::vector<glm::vec3> normals;
  bool bothSides;
};
std::vector<Case> cases() {
  const glm::vec3 up(0, 1, 0), tilted = glm::normalize(glm::vec3(0.5f, 1, -0.2f)), side(0, 0, -1);
  return {{{up}, false},      {{tilted, up}, false}, {{side}, false},     {{up, side, tilted}, false},
          {{up, -up}, false}, {{tilted}, true},      {{up, tilted}, true}};
}

TEST(Directions, HaveADensityWhoseIntegralIsOneAndComeByIt) {
  for (const Case& c : cases()) {
    const Directions directions(c.normals, c.bothSides);
    double total = 0;
    glm::dmat3 found(0), expected(0); // second moments, and with them all that a density may have wrong by and large
    glm::dvec3 mean(0), expectedMean(0);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const glm::dvec3 even = evenDirection(i), taken = directions.at(reference::sobolPoint(i, 6));
      const double weight = directions.pdf(even) * 4 * std::numbers::pi;
      ASSERT_NEAR(glm::length(taken), 1, 1e-9);
      total += weight / kCount;
      mean += taken / double{kCount};
      expectedMean += even * weight / double{kCount};
      found += glm::outerProduct(taken, taken) / double{kCount};
      expected += glm::outerProduct(even, even) * weight / double{kCount};
    }
    EXPECT_NEAR(total, 1, 1e-3);
    EXPECT_NEAR(glm::distance(mean, expectedMean), 0, 1e-3);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(glm::distance(found[k], expected[k]), 0, 1e-3);
  }
}

TEST(Directions, LeaveOutNothingThatAPointSees) {
  for (const Case& c : cases()) {
    const Directions directions(c.normals, c.bothSides);
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const glm::dvec3 direction = evenDirection(i);
      for (const glm::vec3& normal : c.normals)
        if (c.bothSides || glm::dot(glm::dvec3(normal), direction) > 0) {
          ASSERT_GT(directions.pdf(direction), 0);
        }
    }
  }
}

} // namespace
} // namespace parity::bake
