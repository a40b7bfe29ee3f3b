// The brightest light of a kind.
#include "scenes/brightest_light.h"

#include <gtest/gtest.h>

namespace parity::scenes {
namespace {

Light makeLight(LightKind kind, const glm::vec3& color) {
  Light light;
  light.kind = kind;
  light.color = color;
  return light;
}

TEST(BrightestLight, IsOfItsKindByLuminanceAndTheFirstAmongEquals) {
  using enum LightKind;
  const Light lights[] = {makeLight(point, glm::vec3(100)),
                          makeLight(directional, glm::vec3(2)),
                          makeLight(directional, {0, 4.2f, 0}),
                          makeLight(directional, glm::vec3(3)),
                          makeLight(spot, {0, 0, 9}),
                          makeLight(spot, {0, 1, 0}),
                          makeLight(spot, {0, 1, 0})};
  EXPECT_EQ(brightestOf(lights, directional), 2u) << "green is brighter than a grey of 3";
  EXPECT_EQ(brightestOf(lights, spot), 5u) << "blue is dark";
  EXPECT_EQ(brightestOf(lights, point), 0u);
  EXPECT_EQ(brightestOf(std::span(lights, 1), directional), std::nullopt);
  EXPECT_EQ(brightestOf({}, spot), std::nullopt);
}

} // namespace
} // namespace parity::scenes
