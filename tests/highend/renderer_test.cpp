// The high-end path against the formulas of shading/ in double precision, evaluated on the CPU for the same surface.
#include "highend_quad.h"

#include "shading/shading.h"

namespace parity::highend {
namespace {

using shading::Term;
using tests::makeDirectional;
using tests::makeLeaningQuad;
using tests::ShadedPoint;
namespace f64 = shading::f64;

// fp32 against double over some twenty operations, exp2 and divisions among them.
constexpr float kTolerance = 2e-5f;
struct Case {
  float angle, roughness, metallic;
};
constexpr Case kCases[] = {{0.f, 0.5f, 0.f}, {0.7f, 0.2f, 1.f}, {1.3f, 0.9f, 0.5f}, {0.4f, 0.0f, 1.f}};

TEST_F(HighendTest, DirectionalLightIsFullGgxWithSchlickAndLambert) {
  const glm::vec3 towards = glm::normalize(glm::vec3(0.3f, 0.5f, 0.9f)), lux(4, 3, 2), base(0.8f, 0.5f, 0.2f);
  for (const Case& c : kCases)
    for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith}) {
      Options options = kPlain;
      options.model.geometryTerm = term;
      scenes::Scene scene = makeLeaningQuad(c.angle);
      scene.materials[0].baseColor = glm::vec4(base, 1);
      scene.materials[0].metallic = c.metallic;
      scene.materials[0].roughness = c.roughness;
      const ShadedPoint point = shade(scene, {.lights = {makeDirectional(towards, lux)}}, options);

      const glm::dvec3 N(std::sin(c.angle), 0, std::cos(c.angle)), V(0, 0, 1), L = towards, H = glm::normalize(V + L);
      const double NoL = glm::dot(N, L), NoV = glm::dot(N, V), NoH = glm::dot(N, H), VoH = glm::dot(V, H);
      const double alpha = std::pow(std::max<double>(c.roughness, 0.015625), 2);
      const double visibility = term == GeometryTerm::heightCorrelated ? f64::V_SmithGGXCorrelated(alpha, NoV, NoL)
                                                                       : f64::V_SchlickSmith(alpha, NoV, NoL);
      for (int k = 0; k < 3; ++k) {
        const double F0 = 0.04 * (1 - c.metallic) + base[k] * c.metallic, F = F0 + (1 - F0) * std::pow(1 - VoH, 5);
        const double specular = lux[k] * NoL * f64::D_GGX(alpha, NoH) * visibility * F;
        const double diffuse = lux[k] * NoL * base[k] * (1 - c.metallic) / 3.14159265358979;
        // The peak of a smooth lobe multiplies an error of NoH by 1/alpha^2: only its magnitude is asked there.
        const double slack = c.roughness < 0.1f ? 0.05 : kTolerance * 4;
        EXPECT_NEAR(point[Term::sunSpecular][k], specular, slack * specular + 1e-7) << c.roughness;
        EXPECT_NEAR(point[Term::sunDiffuse][k], diffuse, kTolerance * diffuse + 1e-7);
      }
    }
}

TEST_F(HighendTest, PointAndSpotLightsFollowKhrLightsPunctual) {
  scenes::Scene scene = makeLeaningQuad(0);
  scene.materials[0].metallic = 0;
  scenes::Light point;
  point.kind = scenes::LightKind::point;
  point.color = glm::vec3(50);
  point.position = glm::vec3(0, 0, 2000); // far, so that all pixels are lit alike
  point.range = 4000;
  scenes::Light spot = point;
  spot.kind = scenes::LightKind::spot;
  spot.direction = glm::normalize(glm::vec3(0.2f, 0, -1));
  spot.innerConeAngle = 0.1f;
  spot.outerConeAngle = 0.3f;
  for (scenes::Light* light : {&point, &spot}) light->color *= 1e6f;
  const ShadedPoint byPoint = shade(scene, {.lights = {point}}, kPlain);
  const ShadedPoint bySpot = shade(scene, {.lights = {spot}}, kPlain);
  // max(min(1 - (d/r)^4, 1), 0) / d^2 at half the range; Lambert's 1/pi; NoL = 1.
  const double illuminance = 50e6 * (1 - std::pow(0.5, 4)) / (2000.0 * 2000.0);
  tests::expectNear(byPoint[Term::localDiffuse], glm::vec3(illuminance / 3.14159265358979), 1e-3f, "point");
  // Entry 0 is the picture's first pixel, at (-0.875, 0.875) of the 8 x 8.
  const double cosAngle = glm::dot(glm::normalize(glm::dvec3(-0.875, 0.875, -2000)), glm::dvec3(spot.direction));
  const double cone = std::pow((cosAngle - std::cos(0.3)) / (std::cos(0.1) - std::cos(0.3)), 2);
  ASSERT_GT(cone, 0.1);
  tests::expectNear(bySpot[Term::localDiffuse], byPoint[Term::localDiffuse] * static_cast<float>(cone), 2e-3f, "spot");
  EXPECT_EQ(byPoint[Term::sunDiffuse], glm::vec3(0));
}

// A sky of 2 everywhere: A = 0.5, B = 0.1, Eavg = 0.5, so single scattering reflects F0 A + B.
TEST_F(HighendTest, ConstantEnvironmentIsReflectedByTheTableAndCompensated) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 2);
  const base::Image lut = constantLut(0.5f, 0.1f);
  const Inputs inputs{.environment = &environment, .lut = &lut};
  scenes::Scene scene = makeLeaningQuad(0.5f);
  scene.materials[0].baseColor = glm::vec4(0.9f, 0.6f, 0.3f, 1);
  scene.materials[0].metallic = 1;
  const auto skySpecular = [&](Compensation compensation, OffSpecular offSpecular) {
    Options options = kPlain;
    options.compensation = compensation;
    options.offSpecular = offSpecular;
    return shade(scene, inputs, options)[Term::skySpecular];
  };
  for (const OffSpecular offSpecular :
       {OffSpecular::none, OffSpecular::dominant, OffSpecular::stretched, OffSpecular::twoTaps, OffSpecular::threeTaps})
    for (const Compensation compensation :
         {Compensation::none, Compensation::turquin, Compensation::fdezAguera, Compensation::kullaConty}) {
      const glm::vec3 sky = skySpecular(compensation, offSpecular);
      for (int k = 0; k < 3; ++k) {
        const float F0 = scene.materials[0].baseColor[k], single = F0 * 0.5f + 0.1f, Favg = F0 + (1 - F0) / 21;
        const float expected[] = {single, single * (1 + F0 * (1 / 0.6f - 1)),
                                  single + single * Favg * 0.4f / (1 - Favg * 0.4f),
                                  single + Favg * Favg * 0.5f * 0.4f / (1 - Favg * 0.5f)};
        EXPECT_NEAR(sky[k], 2 * expected[static_cast<int>(compensation)], 2e-5f)
            << static_cast<int>(compensation) << ", " << static_cast<int>(offSpecular);
      }
    }
  EXPECT_EQ(shade(scene, inputs, kPlain)[Term::skyDiffuse], glm::vec3(0)) << "a metal has no diffuse lobe";

  scene.materials[0].metallic = 0;
  const glm::vec3 base(scene.materials[0].baseColor);
  tests::expectNear(shade(scene, inputs, kPlain)[Term::skyDiffuse], 2.f * base, 1e-5f, "white sky, Lambert");
  Options balanced = kPlain;
  balanced.model.diffuse = DiffuseLobe::balanced;
  tests::expectNear(shade(scene, inputs, balanced)[Term::skyDiffuse], 2.f * base * (1 - 0.04f * 0.5f - 0.1f), 1e-5f,
                    "what the specular lobe leaves");
}

// A light's share of Kulla and Conty's lobe: Fms (1 - E) (1 - E) / (pi (1 - Eavg)), with E from the table at both
// cosines. Fdez-Aguera's is Lambert's.
TEST_F(HighendTest, LightsScatterMoreThanOnceByTheLobeOfTheirModel) {
  const base::Image lut = constantLut(0.5f, 0.1f);
  scenes::Scene scene = makeLeaningQuad(0.4f);
  scene.materials[0].baseColor = glm::vec4(0.8f, 0.8f, 0.8f, 1);
  scene.materials[0].metallic = 1;
  scene.materials[0].roughness = 0.6f;
  const glm::vec3 towards = glm::normalize(glm::vec3(0.5f, 0.2f, 1));
  const auto specular = [&](Compensation compensation) {
    Options options = kPlain;
    options.compensation = compensation;
    return shade(scene, {.lut = &lut, .lights = {makeDirectional(towards, glm::vec3(3))}}, options)[Term::sunSpecular]
        .x;
  };
  const float NoL = glm::dot(towards, glm::vec3(std::sin(0.4f), 0, std::cos(0.4f))), pi = 3.14159265f;
  const float Favg = 0.8f + 0.2f / 21, single = specular(Compensation::none);
  const float kullaConty = Favg * Favg * 0.5f * 0.4f / (1 - Favg * 0.5f) * 0.4f / (pi * 0.5f);
  EXPECT_NEAR(specular(Compensation::kullaConty) - single, 3 * NoL * kullaConty, 2e-4f * single);
  const float fdezAguera = (0.8f * 0.5f + 0.1f) * Favg * 0.4f / (1 - Favg * 0.4f) / pi;
  EXPECT_NEAR(specular(Compensation::fdezAguera) - single, 3 * NoL * fdezAguera, 2e-4f * single);
  EXPECT_NEAR(specular(Compensation::turquin) / single, 1 + 0.8f * (1 / 0.6f - 1), 1e-4f);
}

TEST_F(HighendTest, FresnelsCurveIsTheOneAskedFor) {
  scenes::Scene scene = makeLeaningQuad(1.2f); // V and L far apart: the curves differ
  scene.materials[0].metallic = 0;
  scene.materials[0].roughness = 0.5f;
  const glm::vec3 towards = glm::normalize(glm::vec3(0.95f, 0, -0.25f));
  const double VoH = glm::dot(glm::normalize(glm::vec3(0, 0, 1) + towards), towards);
  const auto specular = [&](FresnelCurve curve) {
    Options options = kPlain;
    options.model.fresnel = curve;
    return shade(scene, {.lights = {makeDirectional(towards, glm::vec3(3))}}, options)[Term::sunSpecular].x;
  };
  const double schlick = specular(FresnelCurve::schlick) / (0.04 + 0.96 * f64::schlickWeight(VoH));
  ASSERT_GT(schlick, 0);
  EXPECT_NEAR(specular(FresnelCurve::sphericalGaussian) / (0.04 + 0.96 * f64::sphericalGaussianWeight(VoH)) / schlick,
              1, 1e-4);
  EXPECT_NEAR(specular(FresnelCurve::dielectric) / (0.04 + 0.96 * f64::dielectricWeight(VoH)) / schlick, 1, 1e-4);
  EXPECT_GT(std::abs(specular(FresnelCurve::dielectric) / specular(FresnelCurve::schlick) - 1), 0.02);
}

TEST_F(HighendTest, TermsAddUpToTheColour) {
  const gpu::EnvironmentMaps environment = tests::makeConstantEnvironment(device(), 0.7f);
  const base::Image lut = constantLut(0.8f, 0.05f);
  scenes::Scene scene = makeLeaningQuad(0.3f);
  scene.materials[0].emissive = glm::vec3(0.1f, 0.2f, 0.3f);
  scene.materials[0].metallic = 0.3f;
  scenes::Light local;
  local.position = glm::vec3(1, 2, 3);
  local.color = glm::vec3(20);
  const ShadedPoint point = shade(
      scene, {.environment = &environment, .lut = &lut, .lights = {makeDirectional({0, 1, 1}, glm::vec3(2)), local}},
      {});
  glm::vec3 sum(0);
  for (const glm::vec3& term : point.terms) sum += term;
  tests::expectNear(sum, point.color, 1e-3f, "sum of the terms");
  for (const Term t : {Term::sunDiffuse, Term::sunSpecular, Term::localDiffuse, Term::localSpecular, Term::skyDiffuse,
                       Term::skySpecular, Term::emissive})
    EXPECT_GT(point[t].x, 0) << "every term has a part in this scene";
}

TEST_F(HighendTest, UnlitShowsItsBaseColourAndNothingElse) {
  scenes::Scene scene = makeLeaningQuad(0);
  scene.materials[0].unlit = true;
  scene.materials[0].baseColor = glm::vec4(0.2f, 0.4f, 0.6f, 1);
  const ShadedPoint point = shade(scene, {.lights = {makeDirectional({0, 0, 1}, glm::vec3(5))}}, kPlain);
  EXPECT_EQ(point.color, glm::vec3(0.2f, 0.4f, 0.6f));
}

TEST_F(HighendTest, TextureOfAMeshWithoutUvsIsReadAtTheOrigin) {
  scenes::Scene scene = makeLeaningQuad(0);
  scene.meshes[0].uv0.clear();
  scenes::TextureImage image{"two texels", base::Image8(2, 1, 4, 255)};
  image.pixels.pixels = {255, 0, 0, 255, 0, 0, 255, 255};
  scene.images = {image};
  scenes::Material& material = scene.materials[0];
  material.unlit = true;
  material.baseColorTexture.image = 0;
  material.baseColorTexture.sampler.magFilter = material.baseColorTexture.sampler.minFilter = scenes::Filter::nearest;
  EXPECT_EQ(shade(scene, {}, kPlain).color, glm::vec3(1, 0, 0));
}

TEST_F(HighendTest, BackLitAndViewOpposedLightsAreFiniteAndDark) {
  scenes::Scene scene = makeLeaningQuad(0);
  scene.materials[0].roughness = 0;
  // From behind, and exactly against the view: V = -L has no half vector.
  const ShadedPoint point = shade(
      scene, {.lights = {makeDirectional({0, 0, -1}, glm::vec3(5)), makeDirectional({0.1f, 0, -1}, glm::vec3(5))}},
      kPlain);
  EXPECT_EQ(point.color, glm::vec3(0));
}

TEST_F(HighendTest, NormalMapTurnsTheNormalInItsTangentFrame) {
  scenes::Scene scene = tests::makeQuadScene(); // tangent +X, bitangent +Y
  scenes::TextureImage normal{"normal", base::Image8(1, 1, 4, 255)};
  // (0.6, 0, 0.8) encoded: 0.6 -> 204, 0 -> 127.5, 0.8 -> 229.5; rounding moves the angle by at most 0.3 degrees.
  normal.pixels.pixels = {204, 128, 230, 255};
  scene.images = {normal};
  scene.materials[0].normalTexture.image = 0;
  scene.materials[0].metallic = 0;
  const auto diffuseFrom = [&](const glm::vec3& towards) {
    return shade(scene, {.lights = {makeDirectional(towards, glm::vec3(3.14159265f))}}, kPlain)[Term::sunDiffuse].x;
  };
  EXPECT_NEAR(diffuseFrom({0.6f, 0, 0.8f}), 1, 0.01f);
  EXPECT_NEAR(diffuseFrom({0, 0, 1}), 0.8f, 0.01f);
  EXPECT_NEAR(diffuseFrom({-0.6f, 0, 0.8f}), 0.28f, 0.015f);
  // Green is up (OpenGL): +Y in the map is +V of the texture, which runs up the quad here.
  scene.images[0].pixels.pixels = {128, 204, 230, 255};
  EXPECT_NEAR(diffuseFrom({0, 0.6f, 0.8f}), 1, 0.01f);
}

} // namespace
} // namespace parity::highend
