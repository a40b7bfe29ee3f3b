// Anisotropy and thin films of the mobile path: each form on a device against its formulas, and what presets leave out.
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
using tests::ShadedPoint;
namespace f64 = shading::f64;

class MobileMicrofacetsTest : public tests::DeviceTest {
protected:
  ShadedPoint shade(const scenes::Scene& scene, Inputs inputs, const Options& options) {
    inputs.terms = true;
    inputs.compilation.store = &pipelines();
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    });
  }
};

// The tangent is at right angles to the leaning normal, the bitangent +Y.
scenes::Scene makeMetal(float angle, float anisotropy, float iridescence) {
  scenes::Scene scene = tests::makeLeaningQuad(angle);
  scene.meshes[0].tangents.assign(4, glm::vec4(std::cos(angle), 0, -std::sin(angle), 1));
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(0.8f, 0.5f, 0.3f, 1);
  m.metallic = 1;
  m.roughness = 0.4f;
  m.anisotropy = anisotropy;
  m.iridescence = iridescence;
  m.iridescenceThicknessMax = 300;
  return scene;
}

const glm::vec3 kTowardsSun(0.4f, 0.2f, 1);

// The specular colour under the film takes the place of the base's.
TEST_F(MobileMicrofacetsTest, AFilmIsATintOfTheSpecularColour) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs inputs{.environment = &sky, .lights = {makeDirectional(kTowardsSun, glm::vec3(2))}};
  for (const char* preset : {"ue4-2020", "refit"}) {
    Options options = tests::inFp32(preset);
    options.iridescence = IridescenceForm::tint;
    const f64::real3 tint = f64::filmTint(1.3f, 300, {0.8, 0.5, 0.3}, std::cos(0.6));
    scenes::Scene tinted = makeMetal(0.6f, 0, 0);
    tinted.materials[0].baseColor =
        glm::vec4(0.25f * glm::vec3(0.8f, 0.5f, 0.3f) + 0.75f * glm::vec3(tint.x, tint.y, tint.z), 1);
    expectNear(shade(makeMetal(0.6f, 0, 0.75f), inputs, options).color, shade(tinted, inputs, options).color, 1e-3f,
               preset);
  }
}

// A nonmetal under a film has its F0 changed, also where all materials of the permutation are nonmetals.
TEST_F(MobileMicrofacetsTest, AFilmOverANonmetalIsNoShortcut) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs inputs{.environment = &sky};
  scenes::Scene scene = makeMetal(0.3f, 0, 1);
  scene.materials[0].metallic = 0;
  for (const char* preset : {"ue4-2020", "refit"}) {
    Options options = tests::inFp32(preset);
    options.iridescence = IridescenceForm::tint;
    const glm::vec3 with = shade(scene, inputs, options)[Term::skySpecular];
    options.iridescence = IridescenceForm::none;
    const glm::vec3 without = shade(scene, inputs, options)[Term::skySpecular];
    EXPECT_NEAR(without.x, without.y, 1e-5f) << preset << ": grey";
    EXPECT_GT(std::abs(with.x - with.y) + std::abs(with.y - with.z), 0.01f) << preset << ": coloured";
  }
}

// Seen along +Z the fibres along X of a surface that leans to X show a normal along +Z: the bent normal's reflection
// leaves the red wall at +X.
TEST_F(MobileMicrofacetsTest, TheEnvironmentIsReadAboutTheBentNormal) {
  const gpu::EnvironmentMaps sky = tests::makeRedTowardsX(device());
  const Inputs inputs{.environment = &sky};
  for (const char* preset : {"ue4-2020", "refit"}) {
    Options options = tests::inFp32(preset);
    options.capture = CaptureEncoding::fp16;
    options.anisotropy = AnisotropyForm::bent;
    scenes::Scene scene = makeMetal(0.6f, 0, 0);
    scene.materials[0].roughness = 0.1f;
    EXPECT_GT(shade(scene, inputs, options)[Term::skySpecular].x, 0.3f) << preset;
    scene.materials[0].anisotropy = 1;
    EXPECT_LT(shade(scene, inputs, options)[Term::skySpecular].x, 0.1f) << preset;
    scene.materials[0].anisotropyRotation = static_cast<float>(pi / 2); // fibres along Y show the normal itself
    EXPECT_GT(shade(scene, inputs, options)[Term::skySpecular].x, 0.3f) << preset;
  }
}

TEST_F(MobileMicrofacetsTest, TheSunIsReflectedByTheElongatedLobe) {
  const glm::vec3 sun(2, 1, 0.5f);
  const Inputs inputs{.lights = {makeDirectional(kTowardsSun, sun)}};
  const glm::dvec3 N(std::sin(0.3), 0, std::cos(0.3)), T(std::cos(0.3), 0, -std::sin(0.3)), V(0, 0, 1);
  const glm::dvec3 H = glm::normalize(V + glm::normalize(glm::dvec3(kTowardsSun)));
  const tests::QuadCosines c(0.3f, kTowardsSun);
  const f64::MobileAnisotropy a = f64::mobileAnisotropy(0.4, 0.8);
  const double sin2 = f64::squeezedSin2(glm::dot(T, H), H.y, a.squeeze);
  const f64::RefitLobe lobe = f64::refitLobe({0.8, 0.5, 0.3}, 1, a.Roughness, c.NoV);
  const f64::real3 lit = f64::squeezedRefitLight(lobe, c.NoL, {c.NoH, c.VoH}, sin2);
  const ShadedPoint refit = shade(makeMetal(0.3f, 0.8f, 0), inputs, tests::inFp32("refit"));
  expectNear(refit[Term::sunSpecular], glm::vec3(glm::dvec3(lit.x, lit.y, lit.z) * glm::dvec3(sun) / pi), 2e-3f,
             "refit");

  Options ue4 = tests::inFp32("ue4-2020");
  ue4.anisotropy = AnisotropyForm::bent;
  const double k = f64::squeezedCalcSpecular(a.Roughness, c.NoH, sin2) * c.NoL / pi;
  const f64::real3 color = f64::EnvBRDFApproxUE4({0.8, 0.5, 0.3}, a.Roughness, c.NoV);
  const ShadedPoint engine = shade(makeMetal(0.3f, 0.8f, 0), inputs, ue4);
  expectNear(engine[Term::sunSpecular], glm::vec3(k * glm::dvec3(color.x, color.y, color.z) * glm::dvec3(sun)), 2e-3f,
             "ue4");
}

TEST_F(MobileMicrofacetsTest, WhatAPresetLeavesOutIsTheRoundBareLobe) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs inputs{.environment = &sky, .lights = {makeDirectional(kTowardsSun, glm::vec3(2))}};
  for (const char* preset : {"karis2014", "ue4-2020"})
    EXPECT_EQ(shade(makeMetal(0.6f, 0.9f, 1), inputs, tests::inFp32(preset)).color,
              shade(makeMetal(0.6f, 0, 0), inputs, tests::inFp32(preset)).color)
        << preset;
  scenes::Scene rough = makeMetal(0.6f, 0.9f, 1), plain = makeMetal(0.6f, 0, 0);
  rough.materials[0].fullyRough = plain.materials[0].fullyRough = true;
  EXPECT_EQ(shade(rough, inputs, tests::inFp32("refit")).color, shade(plain, inputs, tests::inFp32("refit")).color);
}

// In half, too: the terms add up, and no corner is NaN or infinite.
TEST_F(MobileMicrofacetsTest, CornersAreFiniteAndTermsAddUp) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 2);
  const Inputs inputs{.environment = &sky, .lights = {makeDirectional(kTowardsSun, glm::vec3(2))}};
  for (const char* preset : {"karis2014", "ue4-2020", "refit"})
    for (const auto& [roughness, angle] : {std::pair{0.f, 1.5f}, {0.1f, 0.f}, {1.f, 1.5f}}) {
      Options options = tests::inFp32(preset);
      options.precision = Precision::fp16;
      options.anisotropy = AnisotropyForm::bent, options.iridescence = IridescenceForm::tint;
      if (options.preset == "karis2014" && roughness == 0) continue; // D_Approx itself is NaN there (docs/shading.md 4)
      scenes::Scene scene = makeMetal(angle, 1, 1);
      scene.materials[0].roughness = roughness;
      const ShadedPoint point = shade(scene, inputs, options);
      glm::vec3 sum(0);
      for (const glm::vec3& term : point.terms) sum += term;
      for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(point.color[k])) << preset << " " << roughness;
      expectNear(sum, point.color, 5e-3f, preset);
    }
}

} // namespace
} // namespace parity::mobile
