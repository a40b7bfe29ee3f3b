// Clear coat and sheen of the mobile path: each form on a device against its formulas, and what presets leave out.
#include <numbers>

#include "support/path_quad.h"

#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using shading::Term;
using std::numbers::pi;
using tests::expectNear;
using tests::makeDirectional;
using tests::makeLeaningQuad;
using tests::ShadedPoint;
namespace f64 = shading::f64;

class MobileLobesTest : public tests::DeviceTest {
protected:
  ShadedPoint shade(const scenes::Scene& scene, Inputs inputs, const Options& options) {
    inputs.terms = true;
    inputs.compilation.store = &pipelines();
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    });
  }
};

scenes::Scene makeLayered(float angle, float coat, const glm::vec3& sheen) {
  scenes::Scene scene = makeLeaningQuad(angle);
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(0.5f, 0.3f, 0.2f, 1);
  m.metallic = 0.3f;
  m.roughness = 0.7f;
  m.emissive = glm::vec3(0.5f, 1, 2);
  m.coat = coat, m.coatRoughness = 0.3f;
  m.sheenColor = sheen, m.sheenRoughness = 0.5f;
  return scene;
}

const glm::vec3 kTowards(0.5f, 0.2f, 1);

TEST_F(MobileLobesTest, TheSunOnUE4sCoatIsItsFormula) {
  const glm::vec3 sun(2, 1, 0.5f);
  const Inputs inputs{.lights = {makeDirectional(kTowards, sun)}};
  const ShadedPoint point = shade(makeLayered(0.6f, 0.7f, glm::vec3(0)), inputs, tests::inFp32("ue4-2020"));
  const tests::QuadCosines c(0.6f, kTowards);
  const double F = 0.7 * f64::coatFresnel(c.VoH), lit = f64::coatLightUE4(F, 0.3, c.NoV, c.NoL, c.NoH) / pi;
  expectNear(point[Term::coatSpecular], glm::vec3(lit * glm::dvec3(sun)), 1e-3f, "coat");
  EXPECT_EQ(point[Term::sheen], glm::vec3(0));
  EXPECT_EQ(point[Term::emissive], glm::vec3(0.5f, 1, 2)) << "the engine adds emitted light above the coat";
}

TEST_F(MobileLobesTest, TheSkyOnRefitsCoatIsItsAlbedo) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs inputs{.environment = &sky};
  const ShadedPoint layered = shade(makeLayered(0.6f, 0.7f, glm::vec3(0)), inputs, tests::inFp32("refit"));
  const ShadedPoint base = shade(makeLayered(0.6f, 0, glm::vec3(0)), inputs, tests::inFp32("refit"));
  const double E = f64::refitNonmetalLobe(0.3, std::cos(0.6)).single.x;
  expectNear(layered[Term::coatSpecular], glm::vec3(0.7 * E), 1e-3f, "coat");
  for (const Term term : {Term::skyDiffuse, Term::skySpecular, Term::emissive})
    expectNear(layered[term], static_cast<float>(1 - 0.7 * E) * base[term], 1e-3f, "below the coat");
}

TEST_F(MobileLobesTest, SkyAndSunOnTheSheenAreItsFit) {
  const glm::vec3 sun(2, 1, 0.5f), color(0.8f, 0.4f, 0.2f);
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs skyAlone{.environment = &sky}, sunAlone{.lights = {makeDirectional(kTowards, sun)}};
  const Options options = tests::inFp32("refit");
  const double E = f64::sheenAlbedoFit(0.5, std::cos(0.6));
  const tests::QuadCosines c(0.6f, kTowards);
  const ShadedPoint bySky = shade(makeLayered(0.6f, 0, color), skyAlone, options),
                    bySun = shade(makeLayered(0.6f, 0, color), sunAlone, options);
  expectNear(bySky[Term::sheen], static_cast<float>(E) * color, 1e-3f, "sky");
  const double lit = f64::sheenLightFit(f64::sheenAlpha(0.5), c.NoV, c.NoL, c.NoH) / pi;
  expectNear(bySun[Term::sheen], glm::vec3(lit * glm::dvec3(color * sun)), 1e-3f, "sun");
  const ShadedPoint base = shade(makeLayered(0.6f, 0, glm::vec3(0)), skyAlone, options);
  expectNear(bySky[Term::skyDiffuse], static_cast<float>(1 - 0.8 * E) * base[Term::skyDiffuse], 1e-3f,
             "below the sheen");
}

// The sum of the terms is the colour, in both precisions.
TEST_F(MobileLobesTest, TermsAddUpToTheColour) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 0.8f);
  const Inputs inputs{.environment = &sky, .lights = {makeDirectional(kTowards, glm::vec3(2))}};
  for (const char* preset : {"karis2014", "ue4-2020", "refit"})
    for (const Precision precision : {Precision::fp16, Precision::fp32}) {
      Options options = tests::inFp32(preset);
      options.precision = precision;
      const ShadedPoint point = shade(makeLayered(0.6f, 0.7f, glm::vec3(0.4f)), inputs, options);
      glm::vec3 sum(0);
      for (const glm::vec3& term : point.terms) sum += term;
      expectNear(sum, point.color, precision == Precision::fp16 ? 5e-3f : 1e-5f, preset);
    }
}

TEST_F(MobileLobesTest, WhatAPresetLeavesOutIsTheBaseAlone) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs inputs{.environment = &sky, .lights = {makeDirectional(kTowards, glm::vec3(2))}};
  const glm::vec3 plain = shade(makeLayered(0.6f, 0, glm::vec3(0)), inputs, tests::inFp32("karis2014")).color;
  EXPECT_EQ(shade(makeLayered(0.6f, 1, glm::vec3(1)), inputs, tests::inFp32("karis2014")).color, plain);
  Options none = tests::inFp32("refit");
  none.coat = CoatForm::none, none.sheen = SheenForm::none;
  EXPECT_EQ(shade(makeLayered(0.6f, 1, glm::vec3(1)), inputs, none).color,
            shade(makeLayered(0.6f, 0, glm::vec3(0)), inputs, tests::inFp32("refit")).color);
}

TEST_F(MobileLobesTest, FullyRoughMaterialsHaveNeither) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs inputs{.environment = &sky, .lights = {makeDirectional(kTowards, glm::vec3(2))}};
  scenes::Scene layered = makeLayered(0.6f, 1, glm::vec3(1)), plain = makeLayered(0.6f, 0, glm::vec3(0));
  layered.materials[0].fullyRough = plain.materials[0].fullyRough = true;
  for (const char* preset : {"ue4-2020", "refit"})
    EXPECT_EQ(shade(layered, inputs, tests::inFp32(preset)).color, shade(plain, inputs, tests::inFp32(preset)).color)
        << preset;
}

// Local lights whose sum is beyond half, at a view where a white sheen leaves nothing of the base: 0 times infinite.
TEST_F(MobileLobesTest, LightBeyondHalfUnderALayerStaysANumber) {
  Options options = tests::inFp32("refit");
  options.precision = Precision::fp16;
  scenes::Light lamp;
  lamp.kind = scenes::LightKind::point;
  lamp.position = glm::vec3(0.2f, 0, 0.5f);
  lamp.color = glm::vec3(1e7f);
  scenes::Scene scene = makeLayered(1.555f, 1, glm::vec3(1));
  scene.materials[0].sheenRoughness = 0.07f;
  scene.lights.assign(4, lamp);
  const ShadedPoint point = shade(scene, {.lights = scene.lights}, options);
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(point.color[c])) << point.color[c];
}

// Grazing, smooth, bright: no value that is no number, in half.
TEST_F(MobileLobesTest, HalfIsFiniteAtTheEdges) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 60000);
  for (const char* preset : {"ue4-2020", "refit"})
    for (const float angle : {0.f, 1.5f, 1.5707f})
      for (const float roughness : {0.f, 0.05f, 1.f}) {
        Options options = tests::inFp32(preset);
        options.precision = Precision::fp16;
        scenes::Scene scene = makeLayered(angle, 1, glm::vec3(1));
        scene.materials[0].coatRoughness = scene.materials[0].sheenRoughness = roughness;
        const Inputs inputs{
            .environment = &sky,
            .lights = {makeDirectional(glm::vec3(std::sin(2 * angle), 0, std::cos(2 * angle)), glm::vec3(1e5f))}};
        const ShadedPoint point = shade(scene, inputs, options);
        for (int c = 0; c < 3; ++c)
          EXPECT_TRUE(std::isfinite(point.color[c]) && point.color[c] >= 0)
              << preset << " " << angle << " " << roughness;
      }
}

} // namespace
} // namespace parity::mobile
