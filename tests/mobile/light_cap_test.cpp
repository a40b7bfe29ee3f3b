// All local lights in place of four an object: each adds what it adds alone.
#include "support/path_quad.h"

#include "base/expect_error.h"
#include "highend/renderer.h"
#include "mobile/presets.h"
#include "mobile/renderer.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::ShadedPoint;

// The brightest first, so that an object keeps the first four; of several kinds, colours and falloffs. All reach the
// quad.
std::vector<scenes::Light> makeLocalLights(std::size_t count) {
  std::vector<scenes::Light> lights(count);
  for (std::size_t i = 0; i < count; ++i) {
    scenes::Light& light = lights[i];
    const auto k = static_cast<float>(i);
    light.position = {0.3f * k - 1, 0.2f * k - 0.5f, 2 + 0.1f * k};
    light.color = glm::vec3(8, 6, 4) * std::pow(0.85f, k) + glm::vec3(0, 0, 0.1f * k);
    if (i >= 6) {
      light.range = 30;
      light.falloff = scenes::Falloff::ue4;
    }
    if (i % 2 == 1) {
      light.kind = scenes::LightKind::spot;
      light.direction = glm::normalize(-light.position);
      light.innerConeAngle = 0.9f;
      light.outerConeAngle = 1.2f;
    }
  }
  return lights;
}

class LightCapTest : public tests::DeviceTest {
protected:
  // With a sun before the local lights, and a fainter one that is dropped.
  ShadedPoint shade(std::vector<scenes::Light> lights, const Options& options, bool wide = false) {
    lights.push_back(tests::makeDirectional({0.2f, 0.3f, 1}, glm::vec3(1)));
    lights.push_back(tests::makeDirectional({0.2f, 0.3f, 1}, glm::vec3(0.5f)));
    return tests::shadeQuad(device(), makeScene(), [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, {.lights = lights, .terms = true, .wide = wide}, options);
    });
  }
  static scenes::Scene makeScene(float metallic = 0.5f) {
    scenes::Scene scene = tests::makeLeaningQuad(0.3f);
    scene.materials[0].baseColor = glm::vec4(0.8f, 0.5f, 0.2f, 1);
    scene.materials[0].metallic = metallic;
    scene.materials[0].roughness = 0.4f;
    return scene;
  }
  static Options withCap(const char* preset, bool cap) {
    Options options = tests::inFp32(preset);
    options.lightCap = cap;
    return options;
  }
};

TEST_F(LightCapTest, WithoutItEveryLightAddsWhatItAddsAlone) {
  const std::vector<scenes::Light> lights = makeLocalLights(7);
  for (const char* preset : {"ue4-2020", "refit"}) {
    glm::vec3 diffuse(0), specular(0), fifth(0);
    for (const scenes::Light& light : lights) {
      const ShadedPoint alone = shade({light}, withCap(preset, true));
      EXPECT_GT(alone[Term::localDiffuse].x, 0.02f) << "every light reaches the quad";
      diffuse += alone[Term::localDiffuse];
      specular += alone[Term::localSpecular];
      if (&light == &lights[4]) fifth = alone[Term::localDiffuse];
    }
    for (const bool wide : {false, true}) {
      const ShadedPoint all = shade(lights, withCap(preset, false), wide);
      tests::expectNear(all[Term::localDiffuse], diffuse, 1e-5f, "diffuse");
      tests::expectNear(all[Term::localSpecular], specular, 1e-5f, "specular");
      const ShadedPoint four = shade(lights, withCap(preset, true), wide);
      EXPECT_LT(four[Term::localDiffuse].x, 0.9f * diffuse.x) << "three of seven are left out";
      EXPECT_EQ(all[Term::sunDiffuse], four[Term::sunDiffuse]);
      EXPECT_EQ(all[Term::sunSpecular], four[Term::sunSpecular]);
      // The fifth light alone, on top of the other four.
      const ShadedPoint five = shade({lights.begin(), lights.begin() + 5}, withCap(preset, false), wide);
      tests::expectNear(five[Term::localDiffuse] - four[Term::localDiffuse], fifth, 1e-4f, "the fifth");
    }
  }
}

TEST_F(LightCapTest, WithoutItTheDiffuseLightIsTheHighEndPaths) {
  const std::vector<scenes::Light> lights = makeLocalLights(7);
  const ShadedPoint exact = tests::shadeQuad(device(), makeScene(0), [&](const auto& buffers, const auto& kinds) {
    return highend::Renderer(
        device(), buffers, kinds, {.lights = lights, .terms = true},
        {.model = {.diffuse = highend::DiffuseLobe::lambert}, .compensation = highend::Compensation::none});
  });
  for (const bool cap : {false, true}) {
    const ShadedPoint point = tests::shadeQuad(device(), makeScene(0), [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, {.lights = lights, .terms = true}, withCap("ue4-2020", cap));
    });
    if (cap)
      EXPECT_LT(point[Term::localDiffuse].x, 0.9f * exact[Term::localDiffuse].x);
    else
      tests::expectNear(point[Term::localDiffuse], exact[Term::localDiffuse], 1e-4f, "diffuse");
  }
}

// As they are ranked, they are added up in one order.
TEST_F(LightCapTest, OfFourLightsItChangesNothing) {
  for (const bool wide : {false, true}) {
    const ShadedPoint with = shade(makeLocalLights(4), withCap("ue4-2020", true), wide),
                      without = shade(makeLocalLights(4), withCap("ue4-2020", false), wide);
    EXPECT_GT(with[Term::localDiffuse].x, 0.1f);
    EXPECT_EQ(with.color, without.color);
    EXPECT_EQ(with.terms, without.terms);
  }
}

TEST_F(LightCapTest, WithoutItNothingIsChosenAndNoNoteSpeaksOfFour) {
  const std::vector<scenes::Light> lights = makeLocalLights(7);
  const scenes::Scene scene = makeScene();
  const gpu::SceneBuffers buffers(device(), scene);
  const gpu::SurfacePass pass(device(), buffers, 8, 8);
  for (const bool cap : {false, true}) {
    const Renderer renderer(device(), buffers, pass.binKinds(), {.lights = lights}, withCap("ue4-2020", cap));
    EXPECT_EQ(renderer.pass().localCount(), cap ? 4u : 7u);
    EXPECT_EQ(renderer.work().localLights, cap ? 0u : 7u);
    EXPECT_EQ(renderer.work().lightChoices, cap ? 1u : 0u);
    EXPECT_EQ(renderer.notes().size(), cap ? 1u : 0u);
  }
}

// Of a preset that expects them baked there are none, cap or not.
TEST_F(LightCapTest, BakedLightsStayAway) {
  const ShadedPoint point = shade(makeLocalLights(7), withCap("karis2014", false));
  EXPECT_EQ(point[Term::localDiffuse], glm::vec3(0));
  EXPECT_GT(point[Term::sunDiffuse].x, 0);
}

TEST_F(LightCapTest, MoreLightsThanALoopCanTakeAreRefused) {
  const std::vector<scenes::Light> lights(gpu::kMaxLightsOfAPixel + 1);
  const scenes::Scene scene = makeScene();
  const gpu::SceneBuffers buffers(device(), scene);
  const gpu::SurfacePass pass(device(), buffers, 8, 8);
  base::expectError(
      [&] { Renderer(device(), buffers, pass.binKinds(), {.lights = lights}, withCap("ue4-2020", false)); },
      {"60001 local lights", "without --mobile-light-cap", "at most 60000"});
}

} // namespace
} // namespace parity::mobile
