// Which lights the mobile path evaluates.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
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

TEST(LightChoice, CountsBrightnessAtTheObjectNotAtTheLight) {
  const scenes::Scene scene = tests::makeQuadScene(); // sphere of radius sqrt(2)
  std::vector<scenes::Light> lights = {makeLight(scenes::LightKind::point, 100, {0, 0, 100}),
                                       makeLight(scenes::LightKind::point, 1, {0, 0, 2})};
  const auto chosen = chooseLocalLights(scene, lights);
  EXPECT_EQ(chosen[0], (std::array<std::uint32_t, 4>{1, 0, kNoLight, kNoLight}));
}

// 23 equal lights and a brighter one: which of the equal ones are taken must not depend on how they are sorted.
TEST(LightChoice, TakesTheLowerIndicesAmongEqualLights) {
  const scenes::Scene scene = tests::makeQuadScene();
  std::vector<scenes::Light> lights(24, makeLight(scenes::LightKind::point, 10));
  lights[17] = makeLight(scenes::LightKind::point, 20);
  EXPECT_EQ(chooseLocalLights(scene, lights)[0], (std::array<std::uint32_t, 4>{17, 0, 1, 2}));
}

TEST(LightChoice, LeavesOutLightsWhoseRangeOrConeDoesNotReach) {
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

// Three lights of 10 at 5 m, so 3.59 m from the sphere, range 4: by windows 1 - .65 = .35 and .35^2 over d^2 = 12.9, by
// the exponent (1 - .81)^e of the light itself.
TEST(LightChoice, RanksEachLightByItsOwnFalloff) {
  const scenes::Scene scene = tests::makeQuadScene();
  std::vector<scenes::Light> lights(3, makeLight(scenes::LightKind::point, 10));
  for (scenes::Light& light : lights) light.range = 4;
  lights[0].falloff = scenes::Falloff::ue4;      // .095
  lights[2].falloff = scenes::Falloff::exponent; // 1.94, or 7e-3
  lights[2].falloffExponent = 1;
  EXPECT_EQ(chooseLocalLights(scene, lights)[0], (std::array<std::uint32_t, 4>{2, 1, 0, kNoLight}));
  lights[2].falloffExponent = 4.4f;
  EXPECT_EQ(chooseLocalLights(scene, lights)[0], (std::array<std::uint32_t, 4>{1, 0, 2, kNoLight}));
  const std::uint64_t pixels[] = {3};
  const double share = (5 - std::sqrt(2.0)) / 4;
  EXPECT_NEAR(countLightUse(scene, lights, LightLimit::none, pixels)[2].effect,
              3 * 10 * std::pow(1 - share * share, 4.4), 1e-4);
}

TEST(LightChoice, IsMadePerObject) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.instances.push_back({0, tests::translation(100, 0, 0), "far right"});
  std::vector<scenes::Light> lights;
  for (const float x : {0.f, 100.f}) lights.push_back(makeLight(scenes::LightKind::point, 10, {x, 0, 5}));
  const auto chosen = chooseLocalLights(scene, lights);
  EXPECT_EQ(chosen[0][0], 0u);
  EXPECT_EQ(chosen[1][0], 1u);
}

// Seven of nine lights reach; each of the five that are left over is dropped by the object it is left over at.
TEST(LightUse, DroppedAreThoseBeyondFourThatReach) {
  scenes::Scene scene = tests::makeQuadScene();
  scene.instances.push_back({0, tests::translation(100, 0, 0), "far right"});
  std::vector<scenes::Light> lights(7, makeLight(scenes::LightKind::point, 10));
  for (scenes::Light& light : lights) light.range = 20; // not as far as the second object
  lights[6].position.x = 100;                           // at that one alone
  lights.push_back(makeLight(scenes::LightKind::point, 1000, {0, 0, 50}));
  lights.back().range = 20; // reaches neither
  lights.push_back(makeLight(scenes::LightKind::spot, 1000));
  lights.back().direction = {0, 0, 1}; // shines away from both
  lights.back().outerConeAngle = 0.3f;
  const std::uint64_t pixels[] = {10, 30};
  const std::vector<LightUse> uses = countLightUse(scene, lights, LightLimit::four, pixels);
  ASSERT_EQ(uses.size(), lights.size());
  for (const std::size_t kept : {0, 1, 2, 3, 6}) { // of equal ones the first
    EXPECT_EQ(uses[kept].keptBy, 1u) << kept;
    EXPECT_TRUE(uses[kept].droppedBy.empty()) << kept;
    EXPECT_EQ(uses[kept].effect, 0) << kept;
  }
  for (const std::size_t dropped : {4, 5}) {
    EXPECT_EQ(uses[dropped].keptBy, 0u);
    EXPECT_EQ(uses[dropped].droppedBy, std::vector<std::uint32_t>{0});
    // Luminance 10, sphere of radius sqrt(2) about the origin, 5 m away; the window of the range, 10 pixels.
    const double d = 5 - std::sqrt(2.0), window = 1 - std::pow(d / 20, 4);
    EXPECT_NEAR(uses[dropped].effect, 10 * window / (d * d) * 10, 1e-3);
  }
  for (const std::size_t outside : {7, 8}) EXPECT_EQ(uses[outside].keptBy + uses[outside].droppedBy.size(), 0u);
}

// The same rule as the shaders' slots: who is in an object's four is not dropped by it, whoever else is asked about.
TEST(LightUse, AgreesWithWhatEachObjectIsGiven) {
  scenes::Scene scene = tests::makeQuadScene();
  for (int i = 1; i < 5; ++i)
    scene.instances.push_back({0, tests::translation(static_cast<float>(3 * i), 0, 0), "one of a row"});
  std::vector<scenes::Light> lights;
  for (int i = 0; i < 12; ++i)
    lights.push_back(makeLight(scenes::LightKind::point, 1 + static_cast<float>(i % 5), {static_cast<float>(i), 1, 2}));
  const auto chosen = chooseLocalLights(scene, lights);
  const std::uint64_t pixels[] = {1, 1, 0, 1, 1};
  const std::vector<LightUse> uses = countLightUse(scene, lights, LightLimit::four, pixels);
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    std::size_t kept = 0;
    std::vector<std::uint32_t> without;
    for (std::uint32_t object = 0; object < chosen.size(); ++object) {
      if (pixels[object] == 0) continue;
      if (std::ranges::find(chosen[object], i) != chosen[object].end())
        ++kept;
      else
        without.push_back(object);
    }
    EXPECT_EQ(uses[i].keptBy, kept) << i;
    EXPECT_EQ(uses[i].droppedBy, without) << i;
  }
}

TEST(LightUse, AllSunsButOneAreDroppedAndBakedLightsWithoutException) {
  using enum scenes::LightKind;
  const scenes::Scene scene = tests::makeQuadScene();
  const std::vector<scenes::Light> lights = {makeLight(directional, 2), makeLight(directional, 3), makeLight(point, 5),
                                             makeLight(directional, 0), makeLight(directional, 3)};
  const std::uint64_t pixels[] = {7};
  const std::vector<LightUse> uses = countLightUse(scene, lights, LightLimit::four, pixels);
  const std::vector<std::uint32_t> theQuad = {0}, none = {};
  EXPECT_EQ(uses[0].droppedBy, theQuad);
  EXPECT_FLOAT_EQ(static_cast<float>(uses[0].effect), 2 * 7);
  EXPECT_EQ(uses[1].keptBy, 1u);
  EXPECT_EQ(uses[2].keptBy, 1u);
  EXPECT_EQ(uses[3].keptBy + uses[3].droppedBy.size(), 0u) << "a black light";
  EXPECT_EQ(uses[4].droppedBy, theQuad) << "as bright as the first";
  EXPECT_EQ(countLightUse(scene, lights, LightLimit::none, pixels)[2].droppedBy, theQuad);
  const std::uint64_t unseen[] = {0};
  for (const LightUse& use : countLightUse(scene, lights, LightLimit::none, unseen)) EXPECT_EQ(use.droppedBy, none);
}

// Within an object's sphere the rank is that of the light itself: it would outweigh all that other objects lack.
TEST(LightUse, TheEffectOfALightWithinAnObjectIsBounded) {
  const scenes::Scene scene = tests::makeQuadScene();
  std::vector<scenes::Light> lights(2, makeLight(scenes::LightKind::point, 3, {0, 0, 0.2f}));
  lights[1].range = 0.3f; // fades before it lights all of the object
  const std::uint64_t pixels[] = {5};
  for (const LightUse& use : countLightUse(scene, lights, LightLimit::none, pixels))
    EXPECT_NEAR(use.effect, 3 / 0.5 * 5, 1e-3); // half the radius of sqrt(2), squared
}

TEST(LightUse, WithoutALimitOnlySunsAreDropped) {
  using enum scenes::LightKind;
  const scenes::Scene scene = tests::makeQuadScene();
  std::vector<scenes::Light> lights(6, makeLight(point, 5));
  lights[5].range = 1; // ends before the quad
  lights.push_back(makeLight(directional, 2));
  lights.push_back(makeLight(directional, 3));
  const std::uint64_t pixels[] = {7};
  const auto droppedBy = [&](LightLimit limit) {
    std::vector<std::size_t> dropped;
    const std::vector<LightUse> uses = countLightUse(scene, lights, limit, pixels);
    for (std::size_t i = 0; i < uses.size(); ++i)
      if (!uses[i].droppedBy.empty()) dropped.push_back(i);
    return dropped;
  };
  EXPECT_EQ(droppedBy(LightLimit::none), (std::vector<std::size_t>{0, 1, 2, 3, 4, 6}));
  EXPECT_EQ(droppedBy(LightLimit::four), (std::vector<std::size_t>{4, 6}));
  EXPECT_EQ(droppedBy(LightLimit::all), (std::vector<std::size_t>{6}));
  for (const std::size_t kept : {0, 3, 4, 7})
    EXPECT_EQ(countLightUse(scene, lights, LightLimit::all, pixels)[kept].keptBy, 1u) << kept;
}

TEST(LightUse, NothingCanBeDroppedOfFewLightsNorWithoutALimit) {
  using enum scenes::LightKind;
  std::vector<scenes::Light> lights(4, makeLight(point, 5));
  lights.push_back(makeLight(directional, 1));
  EXPECT_FALSE(mayDropLights(lights, LightLimit::four));
  EXPECT_FALSE(mayDropLights(lights, LightLimit::all));
  EXPECT_TRUE(mayDropLights(lights, LightLimit::none));
  EXPECT_FALSE(mayDropLights(std::span(lights).last(1), LightLimit::none));
  lights.push_back(makeLight(directional, 1));
  EXPECT_TRUE(mayDropLights(lights, LightLimit::four));
  EXPECT_TRUE(mayDropLights(lights, LightLimit::all)) << "two suns";
  lights[5].kind = spot;
  EXPECT_TRUE(mayDropLights(lights, LightLimit::four));
  EXPECT_FALSE(mayDropLights(lights, LightLimit::all));
}

TEST(LightUse, TheLimitIsWhatTheOptionsSay) {
  Options options = presetByName("ue4-2020");
  EXPECT_EQ(lightLimitOf(options), LightLimit::four);
  options.lightCap = false;
  EXPECT_EQ(lightLimitOf(options), LightLimit::all);
  options.localLights = false;
  EXPECT_EQ(lightLimitOf(options), LightLimit::none) << "they are baked";
}

TEST(Presets, TheReflectionIsScaledByWhatTheCubeIs) {
  using enum CaptureScale;
  EXPECT_EQ(captureScaleOf(presetByName("ue4-2020"), true), mixing);
  EXPECT_EQ(captureScaleOf(presetByName("ue4-2020"), false), sky);
  for (const bool hasCaptures : {true, false}) {
    EXPECT_EQ(captureScaleOf(presetByName("karis2014"), hasCaptures), full);
    EXPECT_EQ(captureScaleOf(presetByName("refit"), hasCaptures), occlusion);
  }
  EXPECT_EQ(captureScaleNames()[static_cast<std::size_t>(mixing)], "mixing");
}

TEST(Presets, AreFoundByNameAndUnknownOnesNameTheKnown) {
  for (const std::string& name : presetNames()) EXPECT_EQ(presetByName(name).preset, name);
  EXPECT_EQ(presetByName("karis2014").environmentBrdf, EnvironmentBrdf::karis2014);
  EXPECT_EQ(presetByName("ue4-2020").roughnessFloor, 0.015625f);
  base::expectError([] { presetByName("ue5"); }, {"karis2014, ue4-2020"}, base::ExitCode::usage);
}

} // namespace
} // namespace parity::mobile
