// Anisotropy and thin films of the high-end path against the formulas in double, and energy.
#include "highend_quad.h"

#include <numbers>

#include "shading/shading.h"

namespace parity::highend {
namespace {

using shading::Term;
using tests::expectNear;
using tests::makeDirectional;
using tests::ShadedPoint;
namespace f64 = shading::f64;

constexpr float kQuarterTurn = std::numbers::pi_v<float> / 2;

// A copper metal; its tangent is at right angles to the leaning normal, its bitangent +Y.
scenes::Scene makeBrushed(float angle, float strength, float rotation, float roughness) {
  scenes::Scene scene = tests::makeLeaningQuad(angle);
  scene.meshes[0].tangents.assign(4, glm::vec4(std::cos(angle), 0, -std::sin(angle), 1));
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(0.9f, 0.6f, 0.4f, 1);
  m.metallic = 1;
  m.roughness = roughness;
  m.anisotropy = strength;
  m.anisotropyRotation = rotation;
  return scene;
}

scenes::Scene makeFilm(float angle, float metallic, float ior, float thickness, float roughness) {
  scenes::Scene scene = makeBrushed(angle, 0, 0, roughness);
  scenes::Material& m = scene.materials[0];
  m.metallic = metallic;
  m.iridescence = 1;
  m.iridescenceIor = ior;
  m.iridescenceThicknessMin = 0, m.iridescenceThicknessMax = thickness;
  return scene;
}

struct Local {
  glm::dvec3 v, l, h;
  double VoH;
  Local(double angle, double rotation, const glm::dvec3& towards) {
    const glm::dvec3 N(std::sin(angle), 0, std::cos(angle)), T0(std::cos(angle), 0, -std::sin(angle)), B0(0, 1, 0);
    const glm::dvec3 T = std::cos(rotation) * T0 + std::sin(rotation) * B0, B = glm::cross(N, T);
    const glm::dvec3 V(0, 0, 1), L = glm::normalize(towards), H = glm::normalize(V + L);
    const auto local = [&](const glm::dvec3& d) { return glm::dvec3(glm::dot(T, d), glm::dot(B, d), glm::dot(N, d)); };
    v = local(V), l = local(L), h = local(H), VoH = glm::dot(V, H);
  }
};

TEST_F(HighendTest, TheSunOnBrushedMetalIsTheElongatedLobe) {
  const glm::vec3 towards(0.5f, 0.3f, 1), sun(2, 1, 0.5f);
  const Inputs inputs{.lights = {makeDirectional(towards, sun)}};
  for (const auto& [roughness, rotation] : {std::pair{0.f, 0.7f}, {0.3f, 0.f}, {0.3f, kQuarterTurn}, {0.8f, 0.7f}}) {
    const ShadedPoint point = shade(makeBrushed(0.3f, 0.8f, rotation, roughness), inputs, kPlain);
    const Local at(0.3f, rotation, towards);
    const double alpha = std::pow(std::max<double>(roughness, 0.015625), 2), along = f64::anisotropicAlpha(alpha, 0.8);
    const double D = f64::D_GGXAnisotropic(along, alpha, at.h.x, at.h.y, at.h.z),
                 V = f64::V_SmithGGXAnisotropic(along, alpha, at.v.x, at.v.y, at.v.z, at.l.x, at.l.y, at.l.z);
    const glm::dvec3 F0(0.9, 0.6, 0.4), F = F0 + (1.0 - F0) * std::pow(1 - at.VoH, 5);
    expectNear(point[Term::sunSpecular], glm::vec3(D * V * at.l.z * F * glm::dvec3(sun)), 1e-3f, "sun");
  }
}

TEST_F(HighendTest, TheSunOnAFilmIsReflectedByItsFresnel) {
  const glm::vec3 towards(0.8f, 0.3f, 0.6f), sun(2, 1, 0.5f);
  const Inputs inputs{.lights = {makeDirectional(towards, sun)}};
  for (const float thickness : {0.f, 250.f, 600.f}) {
    const ShadedPoint point = shade(makeFilm(0.3f, 1, 1.4f, thickness, 0.4f), inputs, kPlain);
    const tests::QuadCosines c(0.3f, towards);
    const f64::real3 F = f64::thinFilmFresnel(1.4, thickness, {0.9, 0.6, 0.4}, c.VoH);
    const double lobe = f64::D_GGX(0.16, c.NoH) * f64::V_SmithGGXCorrelated(0.16, c.NoV, c.NoL) * c.NoL;
    expectNear(point[Term::sunSpecular], glm::vec3(lobe * glm::dvec3(F.x, F.y, F.z) * glm::dvec3(sun)), 2e-3f, "film");
  }
}

// An even sky comes back whole from a white base, brushed, under a film, or both.
TEST_F(HighendTest, AWhiteFurnaceStaysWhiteForMicrofacetsToo) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  const Inputs inputs{.environment = &sky, .lut = &lut};
  for (const float angle : {0.2f, 1.3f})
    for (const auto& [strength, film] : {std::pair{0.f, 400.f}, {0.7f, 0.f}, {1.f, 400.f}})
      for (const float metallic : {0.f, 1.f})
        for (const float roughness : {0.1f, 0.7f}) {
          scenes::Scene scene = makeFilm(angle, metallic, 1.5f, film, roughness);
          scenes::Material& m = scene.materials[0];
          m.baseColor = glm::vec4(1);
          m.anisotropy = strength;
          m.anisotropyRotation = 0.4f;
          if (film == 0) m.iridescence = 0;
          const glm::vec3 color = shade(scene, inputs).color;
          for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(color[k], 1, 0.01f)
                << angle << " " << strength << " " << film << " " << metallic << " " << roughness;
        }
}

// Of even light the sum over directions reflects the lobe's albedo: Monte Carlo over half vectors, in double.
TEST_F(HighendTest, EvenLightOnBrushedMetalIsItsAlbedo) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  const Inputs inputs{.environment = &sky, .lut = &lut};
  Options single;
  single.compensation = Compensation::none;
  for (const float angle : {0.2f, 1.f})
    for (const float roughness : {0.3f, 0.7f}) {
      scenes::Scene scene = makeBrushed(angle, 0.7f, 0.5f, roughness);
      scene.materials[0].baseColor = glm::vec4(1);
      const double alpha = roughness * roughness, along = f64::anisotropicAlpha(alpha, 0.7);
      const glm::dvec3 v = Local(angle, 0.5f, glm::dvec3(0, 0, 1)).v;
      double E = 0;
      constexpr int kRows = 600;
      for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < 2 * kRows; ++x) { // slopes by the lobe itself: q, and the azimuth of the round lobe
          const double u = (y + 0.5) / kRows, turn = std::numbers::pi * (x + 0.5) / kRows, r = std::sqrt(u / (1 - u));
          const glm::dvec3 h = glm::normalize(glm::dvec3(along * r * std::cos(turn), alpha * r * std::sin(turn), 1));
          const double VoH = glm::dot(v, h);
          const glm::dvec3 l = 2 * VoH * h - v;
          if (VoH <= 0 || l.z <= 0) continue;
          E += 4 * VoH * l.z / h.z * f64::V_SmithGGXAnisotropic(along, alpha, v.x, v.y, v.z, l.x, l.y, l.z) /
               (2.0 * kRows * kRows);
        }
      EXPECT_NEAR(shade(scene, inputs, single)[Term::skySpecular].x, E, 0.004) << angle << " " << roughness;
    }
}

TEST_F(HighendTest, TexturesOfMicrofacetsAreTheirFactors) {
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  const Inputs inputs{.lut = &lut, .lights = {makeDirectional(glm::vec3(0.5f, 0.3f, 1), glm::vec3(3))}};
  scenes::Scene textured = makeFilm(0.4f, 1, 1.4f, 800, 0.3f);
  textured.images.push_back({"all", base::Image8(2, 2, 4, 0)});
  for (std::size_t i = 0; i < 4; ++i) { // the direction (0, 1), strength and share
    std::uint8_t* texel = textured.images[0].pixels.pixels.data() + 4 * i;
    texel[0] = 128, texel[1] = 255, texel[2] = 204, texel[3] = 255;
  }
  scenes::Material& m = textured.materials[0];
  m.anisotropy = 0.9f;
  m.iridescenceThicknessMin = 200;
  scenes::Scene plain = textured;
  m.anisotropyTexture.image = m.iridescenceTexture.image = 0;
  plain.materials[0].anisotropy = 0.9f * 204 / 255;
  plain.materials[0].anisotropyRotation = kQuarterTurn;
  plain.materials[0].iridescence = 128.f / 255;
  expectNear(shade(textured, inputs)[Term::sunSpecular], shade(plain, inputs)[Term::sunSpecular], 0.01f,
             "direction, which bytes hold to half a degree");
  m.iridescenceThicknessTexture.image = 0;
  m.anisotropyTexture.image = m.iridescenceTexture.image = -1;
  textured.images[0].pixels.pixels.assign(16, 51);
  plain.materials[0] = m;
  plain.materials[0].iridescenceThicknessTexture.image = -1;
  plain.materials[0].iridescenceThicknessMax = 200 + 600 * 0.2f;
  expectNear(shade(textured, inputs)[Term::sunSpecular], shade(plain, inputs)[Term::sunSpecular], 2e-3f, "thickness");
}

TEST_F(HighendTest, HiddenMicrofacetsLeaveTheRoundLobe) {
  const gpu::EnvironmentMaps sky = tests::makeRedTowardsX(device());
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  Inputs inputs{.environment = &sky, .lut = &lut, .lights = {makeDirectional(glm::vec3(0.5f, 0.3f, 1), glm::vec3(3))}};
  scenes::Scene both = makeFilm(0.5f, 1, 1.4f, 500, 0.2f), plain = makeBrushed(0.5f, 0, 0, 0.2f);
  both.materials[0].anisotropy = 0.9f;
  const glm::vec3 color = shade(plain, inputs).color;
  EXPECT_NE(shade(both, inputs).color, color);
  inputs.hiddenFeatures = gpu::kFeatureAnisotropy | gpu::kFeatureIridescence;
  EXPECT_EQ(shade(both, inputs).color, color);
}

// Light that scatters more than once is as much of suns as of a sky, also of a smooth surface: of a white metal all
// that is lost at the first scattering.
TEST_F(HighendTest, SunsOnSmoothBrushedMetalScatterMoreThanOnce) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  scenes::Scene scene = makeBrushed(0.3f, 0.9f, 0.4f, 0);
  scene.materials[0].baseColor = glm::vec4(1);
  constexpr int kSuns = 64; // from everywhere above, each with its part of an even sky
  const glm::vec3 N(std::sin(0.3f), 0, std::cos(0.3f)), T(N.z, 0, -N.x), B(0, 1, 0);
  Inputs suns{.lut = &lut};
  for (int k = 0; k < kSuns; ++k) {
    const float z = (static_cast<float>(k) + 0.5f) / kSuns, r = std::sqrt(1 - z * z),
                turn = 2.4f * static_cast<float>(k);
    suns.lights.push_back(makeDirectional(r * std::cos(turn) * T + r * std::sin(turn) * B + z * N,
                                          glm::vec3(2 * std::numbers::pi_v<float> / kSuns)));
  }
  Options once;
  once.compensation = Compensation::none;
  const float E = shade(scene, {.environment = &sky, .lut = &lut}, once)[Term::skySpecular].x;
  const float more = shade(scene, suns)[Term::sunSpecular].x - shade(scene, suns, once)[Term::sunSpecular].x;
  EXPECT_GT(1 - E, 0.15f);
  EXPECT_NEAR(more, 1 - E, 0.03f * (1 - E));
}

// A scene with lobes shares no shader.
TEST_F(HighendTest, MicrofacetsAmongManyScenesAreWhatTheyAreAlone) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  Inputs inputs{.environment = &sky, .lut = &lut, .lights = {makeDirectional(glm::vec3(0.5f, 0.3f, 1), glm::vec3(3))}};
  const scenes::Scene scene = makeBrushed(0.5f, 0.8f, 0.3f, 0.4f);
  const ShadedPoint own = shade(scene, inputs);
  inputs.compilation.budget = {.own = 0, .shares = true};
  const ShadedPoint shared = shade(scene, inputs);
  EXPECT_EQ(shared.color, own.color);
  EXPECT_EQ(shared[Term::sheen], glm::vec3(0));
  EXPECT_EQ(shared[Term::coatSpecular], glm::vec3(0));
}

} // namespace
} // namespace parity::highend
