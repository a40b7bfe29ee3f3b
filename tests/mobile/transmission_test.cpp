// Light through surfaces in the mobile path: each form against its formula, and what presets leave out.
#include <array>
#include <numbers>

#include "support/look_through.h"
#include "support/path_quad.h"

#include "mobile/presets.h"
#include "mobile/renderer.h"
#include "shading/shading.h"

namespace parity::mobile {
namespace {

using shading::Term;
using tests::expectNear;
using tests::ShadedPoint;
namespace f64 = shading::f64;

class MobileTransmissionTest : public tests::DeviceTest {
protected:
  ShadedPoint shade(const scenes::Scene& scene, Inputs inputs, const Options& options) {
    inputs.terms = true;
    inputs.compilation.store = &pipelines();
    return tests::shadeQuad(device(), scene, [&](const auto& buffers, const auto& kinds) {
      return Renderer(device(), buffers, kinds, inputs, options);
    });
  }
};

// metallic .25, so that a quarter lets nothing through.
scenes::Scene makeGlass(float angle, float roughness, float transmission, float thickness = 0) {
  scenes::Scene scene = tests::makeLeaningQuad(angle);
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(0.8f, 0.6f, 0.4f, 1);
  m.metallic = 0.25f;
  m.roughness = roughness;
  m.transmission = transmission;
  m.thickness = thickness;
  return scene;
}

Options withForm(const char* preset, TransmissionForm form) {
  Options options = tests::inFp32(preset);
  options.transmission = form;
  return options;
}

TEST_F(MobileTransmissionTest, AlphaShowsTheEnvironmentBehindUntinted) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 2);
  const Inputs inputs{.environment = &sky};
  const Options options = withForm("ue4-2020", TransmissionForm::alpha);
  const ShadedPoint glass = shade(makeGlass(0.5f, 0.4f, 0.6f), inputs, options);
  const ShadedPoint none = shade(makeGlass(0.5f, 0.4f, 0.6f), inputs, withForm("ue4-2020", TransmissionForm::none));
  expectNear(glass[Term::transmission], glm::vec3(0.6f * 0.75f * 2), 1e-3f, "behind");
  expectNear(glass[Term::skyDiffuse], 0.4f * none[Term::skyDiffuse], 1e-3f, "what stays");
  expectNear(glass[Term::skySpecular], none[Term::skySpecular], 1e-3f, "reflections");
  EXPECT_EQ(none[Term::transmission], glm::vec3(0));
}

TEST_F(MobileTransmissionTest, OneReadIsTintedAndAbsorbed) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 2);
  const Inputs inputs{.environment = &sky};
  for (const TransmissionForm form : {TransmissionForm::refracted, TransmissionForm::mixed})
    for (const float thickness : {0.f, 0.5f}) {
      scenes::Scene scene = makeGlass(0.6f, 0.4f, 0.6f, thickness);
      scene.materials[0].attenuationColor = glm::vec3(1, 0.5f, 0.25f);
      scene.materials[0].attenuationDistance = 1;
      const ShadedPoint glass = shade(scene, inputs, withForm("refit", form));
      const ShadedPoint none = shade(scene, inputs, withForm("refit", TransmissionForm::none));
      glm::vec3 left(1);
      if (thickness > 0) {
        const f64::Refraction r =
            f64::throughSphere({std::sin(0.6), 0, std::cos(0.6)}, {0, 0, 1}, 1.5, thickness, 0.16);
        const double R = f64::reflectedWithin(0.16, 1.5, r.cosine);
        for (int c = 0; c < 3; ++c) {
          const double kept = std::pow(std::array{1.0, 0.5, 0.25}[static_cast<std::size_t>(c)], r.path);
          left[c] = static_cast<float>(kept * (1 - R + f64::leavingLater(R, kept, 0.4, 1.5)));
        }
      }
      expectNear(glass[Term::transmission], 0.6f * none[Term::skyDiffuse] * left, 2e-3f,
                 "as diffuse light of the share");
      expectNear(glass[Term::skyDiffuse], 0.4f * none[Term::skyDiffuse], 2e-3f, "what stays");
    }
}

TEST_F(MobileTransmissionTest, ABodyBendsTheRead) {
  const gpu::EnvironmentMaps environment = tests::makeRedTowardsX(device());
  const Inputs inputs{.environment = &environment};
  const Options options = withForm("refit", TransmissionForm::refracted);
  scenes::Scene body = makeGlass(-1.3f, 0, 1, 0.5f);
  body.materials[0].ior = 2.5f; // the ray leaves towards +X (tests/highend/transmission_test.cpp)
  EXPECT_GT(shade(body, inputs, options)[Term::transmission].x, 0.1f);
  body.materials[0].thickness = 0;
  EXPECT_LT(shade(body, inputs, options)[Term::transmission].x, 1e-3f) << "through a wall straight on";
}

TEST_F(MobileTransmissionTest, TheSunOfTheOtherSideIsLamberts) {
  const glm::vec3 behind(0.4f, 0.2f, -1), sun(2, 1, 0.5f);
  const Inputs inputs{.lights = {tests::makeDirectional(behind, sun)}};
  scenes::Scene scene = makeGlass(0.3f, 0.5f, 0);
  scene.materials[0].diffuseTransmission = 0.5f;
  scene.materials[0].diffuseTransmissionColor = glm::vec3(0.9f, 0.6f, 0.3f);
  const ShadedPoint leaf = shade(scene, inputs, tests::inFp32("refit"));
  const glm::dvec3 N(std::sin(0.3f), 0, std::cos(0.3f));
  const double NoL = -glm::dot(N, glm::normalize(glm::dvec3(behind)));
  expectNear(leaf[Term::transmission],
             glm::vec3(0.75 * 0.5 * NoL / std::numbers::pi * glm::dvec3(0.9, 0.6, 0.3) * glm::dvec3(sun)), 1e-3f,
             "sun");
  EXPECT_EQ(shade(scene, inputs, tests::inFp32("ue4-2020"))[Term::transmission], glm::vec3(0)) << "the engine has none";
}

TEST_F(MobileTransmissionTest, FullyRoughMaterialsLetNothingThrough) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  scenes::Scene scene = makeGlass(0.3f, 0.5f, 0.8f);
  scene.materials[0].diffuseTransmission = 0.5f;
  scene.materials[0].fullyRough = true;
  for (const char* preset : {"ue4-2020", "refit"}) {
    const ShadedPoint point = shade(scene, {.environment = &sky}, tests::inFp32(preset));
    EXPECT_EQ(point[Term::transmission], glm::vec3(0)) << preset;
    EXPECT_GT(point[Term::skyDiffuse].x, 0.1f) << preset;
  }
}

// Behind a coat and a sheen it is dimmed as the base.
TEST_F(MobileTransmissionTest, LayersDimIt) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const Inputs inputs{.environment = &sky};
  scenes::Scene scene = makeGlass(0.3f, 0.5f, 0.8f);
  const ShadedPoint bare = shade(scene, inputs, tests::inFp32("refit"));
  scene.materials[0].sheenColor = glm::vec3(0.8f);
  scene.materials[0].sheenRoughness = 0.5f;
  const ShadedPoint dimmed = shade(scene, inputs, tests::inFp32("refit"));
  const float below = dimmed[Term::skySpecular].x / bare[Term::skySpecular].x;
  EXPECT_LT(below, 0.99f);
  expectNear(dimmed[Term::transmission], below * bare[Term::transmission], 1e-3f, "below the sheen");
}

// alpha shows the wall behind as it is, mixed in the glass's colour and less of it the rougher the glass; refracted
// sees past it.
TEST_F(MobileTransmissionTest, TheWallBehindShowsByForm) {
  const scenes::Camera camera = tests::makeFrontCamera(1, 3, true);
  const auto redSeen = [&](TransmissionForm form, float roughness) {
    scenes::Scene scene = tests::makePaneBeforeWall(roughness, 1);
    scene.materials[0].baseColor = glm::vec4(0.5f, 1, 1, 1);
    const Inputs inputs{.terms = true};
    const tests::LookedThrough seen =
        tests::lookThrough(device(), scene, camera, [&](const auto& buffers, const auto& kinds) {
          return Renderer(device(), buffers, kinds, inputs, withForm("refit", form));
        });
    EXPECT_EQ(seen.readsBackdrop, form != TransmissionForm::refracted);
    return seen.image.at(16, 32)[0];
  };
  EXPECT_NEAR(redSeen(TransmissionForm::alpha, 0.4f), 1, 1e-3f);
  EXPECT_NEAR(redSeen(TransmissionForm::mixed, 0), 0.5f * 0.96f, 0.02f);
  EXPECT_NEAR(redSeen(TransmissionForm::mixed, 0.25f), 0.5f * 0.5f * 0.96f, 0.02f);
  EXPECT_EQ(redSeen(TransmissionForm::mixed, 0.6f), 0);
  EXPECT_EQ(redSeen(TransmissionForm::refracted, 0), 0);
}

// In half every term is finite at the ends of the domain.
TEST_F(MobileTransmissionTest, InHalfNothingIsNaN) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 60000);
  Options options = presetByName("refit");
  for (const TransmissionForm form : {TransmissionForm::alpha, TransmissionForm::refracted, TransmissionForm::mixed})
    for (const float angle : {0.f, 1.5f, 1.6f})
      for (const float roughness : {0.f, 1.f})
        for (const float thickness : {0.f, 1e-6f, 1e6f})
          for (const float ior : {1.f, 1.5f, 1e6f}) {
            options.transmission = form;
            scenes::Scene scene = makeGlass(angle, roughness, 1, thickness);
            scene.materials[0].ior = ior;
            scene.materials[0].attenuationColor = glm::vec3(0, 0.5f, 1);
            scene.materials[0].attenuationDistance = 1e-3f;
            const ShadedPoint point = shade(scene, {.environment = &sky}, options);
            for (int c = 0; c < 3; ++c)
              EXPECT_TRUE(std::isfinite(point.color[c]) && point[Term::transmission][c] >= 0)
                  << angle << " " << roughness << " " << thickness << " " << ior;
          }
}

} // namespace
} // namespace parity::mobile
