// Light through surfaces in the high-end path: thin walls, bodies, diffuse light, the backdrop, energy.
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

// A white dielectric that lets all light through.
scenes::Scene makeGlass(float angle, float roughness, float thickness = 0) {
  scenes::Scene scene = tests::makeLeaningQuad(angle);
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(1);
  m.metallic = 0;
  m.roughness = roughness;
  m.transmission = 1;
  m.thickness = thickness;
  return scene;
}

class TransmissionTest : public HighendTest {
protected:
  base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);
  Inputs under(const gpu::EnvironmentMaps& sky) const { return {.environment = &sky, .lut = &lut, .transmits = true}; }
  Inputs under(const scenes::Light& light) const { return {.lut = &lut, .transmits = true, .lights = {light}}; }
};

TEST_F(TransmissionTest, AWhiteFurnaceStaysWhite) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  for (const float angle : {0.f, 0.8f, 1.4f})
    for (const float roughness : {0.f, 0.3f, 1.f})
      for (const float thickness : {0.f, 0.5f})
        for (const float transmission : {0.4f, 1.f})
          for (const float diffuse : {0.f, 0.7f}) {
            scenes::Scene scene = makeGlass(angle, roughness, thickness);
            scene.materials[0].transmission = transmission;
            scene.materials[0].diffuseTransmission = diffuse;
            scene.materials[0].dispersion = thickness;
            const ShadedPoint point = shade(scene, under(sky));
            EXPECT_NEAR(point.color.x, 1, 0.01f)
                << angle << " " << roughness << " " << thickness << " " << transmission;
            EXPECT_GT(point[Term::transmission].x, 0.1f);
          }
}

// What the reflection leaves, in the material's colour; metals let nothing through.
TEST_F(TransmissionTest, TheBaseKeepsWhatDoesNotPass) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  scenes::Scene scene = makeGlass(0.5f, 0.4f);
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(0.8f, 0.4f, 0.2f, 1);
  m.transmission = 0.25f;
  m.diffuseTransmission = 0.5f;
  m.diffuseTransmissionColor = glm::vec3(0.1f, 0.2f, 0.9f);
  const ShadedPoint mixed = shade(scene, under(sky));
  m.transmission = m.diffuseTransmission = 0;
  m.sheenColor = glm::vec3(0);
  m.coat = 1e-6f; // keeps the shader
  const base::Image sheen(lut.width, lut.height, 1);
  Inputs inputs = under(sky);
  inputs.sheenTable = &sheen;
  const ShadedPoint bare = shade(scene, inputs);
  expectNear(mixed[Term::skyDiffuse], 0.75f * 0.5f * bare[Term::skyDiffuse], 1e-4f, "what stays");
  expectNear(mixed[Term::skySpecular], bare[Term::skySpecular], 1e-4f, "reflections");
  const glm::vec3 left = bare[Term::skyDiffuse] / glm::vec3(0.8f, 0.4f, 0.2f);
  expectNear(mixed[Term::transmission],
             left * (0.25f * glm::vec3(0.8f, 0.4f, 0.2f) + 0.75f * 0.5f * glm::vec3(0.1f, 0.2f, 0.9f)), 1e-3f,
             "what passes");
  m.transmission = 1;
  m.metallic = 1;
  EXPECT_EQ(shade(scene, inputs)[Term::transmission], glm::vec3(0));
}

TEST_F(TransmissionTest, ASmoothWallShowsWhatIsStraightBehindAndABodyBendsIt) {
  const gpu::EnvironmentMaps environment = tests::makeRedTowardsX(device());
  // Seen along -Z: straight on is black.
  EXPECT_LT(shade(makeGlass(0.7f, 0), under(environment))[Term::transmission].x, 1e-4f);
  // A body whose normal leans to -X bends the ray towards +X: by 2 (theta - theta_t) of it.
  scenes::Scene body = makeGlass(-1.3f, 0, 0.5f);
  body.materials[0].ior = 2.5f;
  const f64::Refraction r = f64::throughSphere({-std::sin(1.3), 0, std::cos(1.3)}, {0, 0, 1}, 2.5, 0.5, 0);
  ASSERT_GT(r.outside.x, 0.9);
  const ShadedPoint bent = shade(body, under(environment));
  EXPECT_GT(bent[Term::transmission].x, 0.3f);
  EXPECT_EQ(bent[Term::transmission].y, 0);
}

// What leaves a smooth ball of the light that entered it at this angle; the ball is `thickness` attenuation distances
// wide.
glm::vec3 leavingBody(double ior, double angle, const glm::dvec3& attenuationColor, double thickness) {
  const double cosine = std::sqrt(1 - std::pow(std::sin(angle) / ior, 2)), R = f64::reflectedWithin(0, ior, cosine);
  const glm::dvec3 left = glm::pow(attenuationColor, glm::dvec3(thickness * cosine));
  return glm::vec3(left * (1 - R) / (1.0 - R * left));
}

// On the straight way once, and once more after each reflection within.
TEST_F(TransmissionTest, ABodyAbsorbsAlongItsPaths) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  scenes::Scene scene = makeGlass(0.6f, 0, 0.5f);
  const ShadedPoint clear = shade(scene, under(sky));
  scene.materials[0].attenuationColor = glm::vec3(1, 0.5f, 0.1f);
  scene.materials[0].attenuationDistance = 2;
  const auto expectedAt = [](double scale) { return leavingBody(1.5, 0.6, {1, 0.5, 0.1}, 0.5 * scale / 2); };
  expectNear(shade(scene, under(sky))[Term::transmission], clear[Term::transmission] * expectedAt(1), 1e-3f,
             "absorbed");
  // The object's scale counts: twice as large, twice as thick.
  scene.instances[0].toWorld = glm::mat4(2.f);
  scene.instances[0].toWorld[3][3] = 1;
  expectNear(shade(scene, under(sky))[Term::transmission], clear[Term::transmission] * expectedAt(2), 1e-3f, "scaled");
}

// Each channel goes its own way, which is as long as its index has it.
TEST_F(TransmissionTest, DispersionGivesEachChannelItsIndex) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  scenes::Scene scene = makeGlass(0.9f, 0, 0.5f);
  const ShadedPoint clear = shade(scene, under(sky));
  scene.materials[0].attenuationColor = glm::vec3(0.1f);
  scene.materials[0].attenuationDistance = 0.25f;
  scene.materials[0].dispersion = 20;
  const auto iors = f64::dispersedIors(1.5, 20);
  ASSERT_NEAR(iors.z - iors.x, 0.5, 1e-9);
  const auto leaving = [](double ior) { return leavingBody(ior, 0.9, glm::dvec3(0.1), 2).x; };
  const glm::vec3 expected(leaving(iors.x), leaving(iors.y), leaving(iors.z));
  ASSERT_GT(expected.x / expected.z, 1.5f);
  expectNear(shade(scene, under(sky))[Term::transmission], clear[Term::transmission] * expected, 2e-3f, "dispersed");
}

// What is occluded is as dark through glass as it is on a surface.
TEST_F(TransmissionTest, OcclusionDimsTheLightOfTheEnvironment) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  for (const float thickness : {0.f, 0.5f})
    for (const float transmission : {0.f, 1.f}) { // 0: diffuse light alone
      scenes::Scene scene = makeGlass(0.4f, 0.3f, thickness);
      scene.materials[0].transmission = transmission;
      scene.materials[0].diffuseTransmission = 1;
      const ShadedPoint open = shade(scene, under(sky));
      scene.images.push_back({"occlusion", base::Image8(2, 2, 4, 102)});
      scene.materials[0].occlusionTexture.image = 0;
      ASSERT_GT(open[Term::transmission].x, 0.3f);
      expectNear(shade(scene, under(sky))[Term::transmission], 0.4f * open[Term::transmission], 2e-3f, "occluded");
    }
}

// A light behind a thin wall: GGX's lobe about its direction through the wall, as much of it as the lobe's albedo
// loses.
TEST_F(TransmissionTest, TheSunThroughAThinWallIsTheMirroredLobe) {
  const glm::vec3 behind(0.4f, 0.2f, -1), sun(2, 1, 0.5f);
  for (const float roughness : {0.2f, 0.6f}) {
    const ShadedPoint point = shade(makeGlass(0.4f, roughness), under(makeDirectional(behind, sun)), kPlain);
    const glm::dvec3 N(std::sin(0.4f), 0, std::cos(0.4f)), V(0, 0, 1);
    const glm::dvec3 L = glm::normalize(glm::dvec3(behind)), mirrored = L - 2 * glm::dot(N, L) * N,
                     H = glm::normalize(V + mirrored);
    const double alpha = std::pow(roughness, 2), NoV = glm::dot(N, V), NoL = glm::dot(N, mirrored);
    const double lobe = f64::D_GGX(alpha, glm::dot(N, H)) * f64::V_SmithGGXCorrelated(alpha, NoV, NoL) * NoL;
    const auto x = static_cast<int>(std::lround(NoV * (lut.width - 1))),
               y = static_cast<int>(std::lround(roughness * (lut.height - 1)));
    const double E = lut.at(x, y)[0] + lut.at(x, y)[1];
    expectNear(point[Term::transmission], glm::vec3(lobe / E * glm::dvec3(sun)), 1e-2f, "sun");
    EXPECT_EQ(point[Term::sunSpecular], glm::vec3(0));
  }
  EXPECT_EQ(shade(makeGlass(0.4f, 0.4f, 0.5f), under(makeDirectional(behind, sun)), kPlain)[Term::transmission],
            glm::vec3(0))
      << "no light shines through a body";
}

TEST_F(TransmissionTest, DiffuseLightOfTheOtherSidePasses) {
  const glm::vec3 behind(0.4f, 0.2f, -1), sun(2, 1, 0.5f);
  scenes::Scene scene = makeGlass(0.3f, 0.8f);
  scenes::Material& m = scene.materials[0];
  m.transmission = 0.2f;
  m.diffuseTransmission = 0.5f;
  m.diffuseTransmissionColor = glm::vec3(0.9f, 0.6f, 0.3f);
  m.thickness = 0.5f; // a body, so that its specular lobe is left out
  const ShadedPoint point = shade(scene, under(makeDirectional(behind, sun)), kPlain);
  const glm::dvec3 N(std::sin(0.3f), 0, std::cos(0.3f));
  const double NoL = -glm::dot(N, glm::normalize(glm::dvec3(behind)));
  expectNear(point[Term::transmission],
             glm::vec3(0.8 * 0.5 * NoL / std::numbers::pi * glm::dvec3(0.9, 0.6, 0.3) * glm::dvec3(sun)), 1e-4f, "sun");
}

// The texels scale the factors: transmission by R, thickness by G, diffuse transmission by A, its colour as sRGB.
TEST_F(TransmissionTest, TexturesScaleTheFactors) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  scenes::Scene textured = makeGlass(0.4f, 0.3f, 0.8f);
  textured.images.push_back({"all", base::Image8(2, 2, 4, 0)});
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint8_t* texel = textured.images[0].pixels.pixels.data() + 4 * i;
    texel[0] = 102, texel[1] = 153, texel[2] = 204, texel[3] = 127;
  }
  scenes::Material& m = textured.materials[0];
  m.diffuseTransmission = 0.9f;
  m.attenuationDistance = 1, m.attenuationColor = glm::vec3(0.3f, 0.6f, 0.9f);
  scenes::Scene plain = textured;
  for (scenes::TextureSlot* slot :
       {&m.transmissionTexture, &m.thicknessTexture, &m.diffuseTransmissionTexture, &m.diffuseTransmissionColorTexture})
    slot->image = 0;
  scenes::Material& p = plain.materials[0];
  p.transmission = 0.4f;
  p.thickness = 0.8f * 0.6f;
  p.diffuseTransmission = 0.9f * 127 / 255.f;
  p.diffuseTransmissionColor = glm::vec3(f64::srgbToLinear(0.4), f64::srgbToLinear(0.6), f64::srgbToLinear(0.8));
  const ShadedPoint a = shade(textured, under(sky)), b = shade(plain, under(sky));
  expectNear(a[Term::transmission], b[Term::transmission], 2e-3f, "what passes");
  expectNear(a[Term::skyDiffuse], b[Term::skyDiffuse], 2e-3f, "what stays");
}

// Light that passes lies under coat and sheen as the base does.
TEST_F(TransmissionTest, LayersDimIt) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 1);
  base::Image sheen(lut.width, lut.height, 1);
  std::ranges::fill(sheen.pixels, 0.25f);
  Inputs inputs = under(sky);
  inputs.sheenTable = &sheen;
  scenes::Scene scene = makeGlass(0.5f, 0.4f);
  const ShadedPoint bare = shade(scene, inputs);
  scene.materials[0].sheenColor = glm::vec3(0.8f);
  const ShadedPoint sheened = shade(scene, inputs);
  expectNear(sheened[Term::transmission], 0.8f * bare[Term::transmission], 1e-4f, "0.8 = 1 - 0.8 0.25");
}

} // namespace
} // namespace parity::highend
