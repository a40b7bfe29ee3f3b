// Which lights the mobile path evaluates.
#include <gtest/gtest.h>

#include "base/error.h"
#include "mobile/light_choice.h"
#include "mobile/renderer.h"
#include "support/small_scenes.h"

namespace parity::mobile {
namespace {

scenes::Light makeLight(scenes::LightKind kind, float intensity, const glm::vec3& position = glm::vec3(0, 0, 5)) {
  scenes::Light light;
  light.kind = kind;
  light.color = glm::vec3(intensity);
  light.position = position;
  return light;
}

TEST(LightChoice, sunIsTheBrightestDirectionalLightAndTheFirstAmongEquals) {
  using enum scenes::LightKind;
  const scenes::Light lights[] = {makeLight(point, 100), makeLight(directional, 2), makeLight(directional, 3),
                                  makeLight(directional, 3)};
  EXPECT_EQ(chooseSun(lights), 2u);
  EXPECT_EQ(chooseSun(std::span(lights, 1)), std::nullopt);
}

TEST(LightChoice, theShadowIsOfTheBrightestSpotAndTheFirstAmongEquals) {
  using enum scenes::LightKind;
  const scenes::Light lights[] = {makeLight(point, 100), makeLight(spot, 2), makeLight(spot, 3), makeLight(spot, 3)};
  EXPECT_EQ(chooseShadowSpot(lights), 2u);
  EXPECT_EQ(chooseShadowSpot(std::span(lights, 1)), std::nullopt);
}

TEST(LightChoice, countsBrightnessAtTheObjectNotAtTheLight) {
  const scenes::Scene scene = tests::makeQuadScene(); // sphere of radius sqrt(2)
  std::vector<scenes::Light> lights = {makeLight(scenes::LightKind::point, 100, {0, 0, 100}),
                                       makeLight(scenes::LightKind::point, 1, {0, 0, 2})};
  const auto chosen = chooseLocalLights(scene, lights);
  EXPECT_EQ(chosen[0], (std::array<std::uint32_t, 4>{1, 0, kNoLight, kNoLight}));
}

// 23 equal lights and a brighter one: which of the equal ones are taken must not depend on how they are sorted.
TEST(LightChoice, takesTheLowerIndicesAmongEqualLights) {
  const scenes::Scene scene = tests::makeQuadScene();
  std::vector<scenes::Light> lights(24, makeLight(scenes::LightKind::point, 10));
  lights[17] = makeLight(scenes::LightKind::point, 20);
  EXPECT_EQ(chooseLocalLights(scene, lights)[0], (std::array<std::uint32_t, 4>{17, 0, 1, 2}));
}

TEST(LightChoice, leavesOutLightsWhoseRangeOrConeDoesNotReach) {
  const scenes::Scene scene = tests::makeQuadScene();
  std::vector<scenes::Light> lights = {makeLight(scenes::LightKind::point, 100, {0, 0, 10}),
                                       makeLight(scenes::LightKind::spot, 100, {0, 0, 10}),
                                       makeLight(scenes::LightKind::spot, 100, {0, 0, 10})};
  lights[0].range = 5;
  lights[1].direction = glm::vec3(0, 0, 1); // away
  lights[1].outerConeAngle = 0.5f;
  lights[2].direction = glm::normalize(glm::vec3(0.55f, 0, -1)); // its axis passes by, its cone touches the sphere
  lights[2].outerConeAngle = 0.5f;
  EXPECT_EQ(chooseLocalLights(scene, lights)[0], (std::array<std::uint32_t, 4>{2, kNoLight, kNoLight, kNoLight}));
}

TEST(LightChoice, isMadePerObject) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.instances.push_back({0, tests::translation(100, 0, 0), "far right"});
  std::vector<scenes::Light> lights;
  for (const float x : {0.f, 100.f}) lights.push_back(makeLight(scenes::LightKind::point, 10, {x, 0, 5}));
  const auto chosen = chooseLocalLights(scene, lights);
  EXPECT_EQ(chosen[0][0], 0u);
  EXPECT_EQ(chosen[1][0], 1u);
}

TEST(Presets, areFoundByNameAndUnknownOnesNameTheKnown) {
  for (const std::string& name : presetNames()) EXPECT_EQ(presetByName(name).preset, name);
  EXPECT_EQ(presetByName("karis2014").environmentBrdf, EnvironmentBrdf::karis2014);
  EXPECT_EQ(presetByName("ue4-2020").roughnessFloor, 0.015625f);
  try {
    presetByName("ue5");
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("karis2014, ue4-2020"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace parity::mobile
