// Clear coat and sheen of the high-end path against the formulas written out in double, and what scenes without them
// keep.
#include "highend_quad.h"

#include <numbers>

#include "highend/sheen_table.h"
#include "shading/shading.h"

namespace parity::highend {
namespace {

using shading::Term;
using tests::expectNear;
using tests::makeDirectional;
using tests::makeLeaningQuad;
using tests::ShadedPoint;
namespace f64 = shading::f64;

// A brown dielectric, so that the base is seen beside its layers.
scenes::Scene makeLayered(float angle, float coat, float coatRoughness, const glm::vec3& sheen, float sheenRoughness) {
  scenes::Scene scene = makeLeaningQuad(angle);
  scenes::Material& m = scene.materials[0];
  m.baseColor = glm::vec4(0.4f, 0.3f, 0.2f, 1);
  m.metallic = 0;
  m.roughness = 0.6f;
  m.emissive = glm::vec3(0.5f, 1, 2);
  m.coat = coat, m.coatRoughness = coatRoughness;
  m.sheenColor = sheen, m.sheenRoughness = sheenRoughness;
  return scene;
}

// Points that share out an even sky of radiance 1: latitudes and longitudes.
gpu::EnvironmentMaps makeEvenSky(const gpu::Device& device) {
  gpu::EnvironmentMaps maps = tests::makeConstantEnvironment(device, 1);
  std::vector<gpu::GpuEnvironmentPoint> points(gpu::kEnvironmentPoints);
  const auto fill = [&](std::size_t first, int rows, int columns) {
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        const double z = 1 - (y + 0.5) * 2 / rows, turn = 2 * std::numbers::pi * (x + 0.5 * (y % 2)) / columns,
                     r = std::sqrt(1 - z * z);
        points[first++] = {glm::vec4(r * std::cos(turn), z, r * std::sin(turn), 0),
                           glm::vec4(4 * std::numbers::pi / (rows * columns))};
      }
  };
  fill(0, 16, 32);
  fill(gpu::kFewPoints, 32, 32);
  maps.points.emplace(device, std::span<const gpu::GpuEnvironmentPoint>(points));
  return maps;
}

TEST_F(HighendTest, TheSunOnTheCoatIsItsOwnLobe) {
  const glm::vec3 towards(0.3f, 0.2f, 1), sun(2, 1, 0.5f);
  const base::Image lut = constantLut(0.7f, 0.05f), sheen = base::Image(2, 2, 1);
  const Inputs inputs{.lut = &lut, .sheenTable = &sheen, .lights = {makeDirectional(towards, sun)}};
  for (const float roughness : {0.f, 0.2f, 0.7f}) {
    const ShadedPoint layered = shade(makeLayered(0.5f, 0.8f, roughness, glm::vec3(0), 0), inputs, kPlain);
    const ShadedPoint base = shade(makeLayered(0.5f, 0, 0, glm::vec3(0), 0), inputs, kPlain);
    const tests::QuadCosines c(0.5f, towards);
    const double alpha = std::pow(std::max<double>(roughness, 0.015625), 2);
    const double F = 0.04 + 0.96 * std::pow(1 - c.VoH, 5);
    const double lobe = F * f64::D_GGX(alpha, c.NoH) * f64::V_SmithGGXCorrelated(alpha, c.NoV, c.NoL) * c.NoL;
    expectNear(layered[Term::coatSpecular], glm::vec3(0.8 * lobe * glm::dvec3(sun)), 2e-4f, "coat");
    const float below = 1 - 0.8f * (0.04f * 0.7f + 0.05f);
    for (const Term term : {Term::sunDiffuse, Term::sunSpecular, Term::emissive})
      expectNear(layered[term], below * base[term], 1e-5f, "below the coat");
    EXPECT_EQ(layered[Term::sheen], glm::vec3(0));
  }
}

TEST_F(HighendTest, TheSunOnTheSheenIsCharliesLobe) {
  const glm::vec3 towards(0.9f, 0.2f, 0.4f), sun(2, 1, 0.5f), color(0.9f, 0.5f, 0.1f);
  const base::Image lut = constantLut(0.7f, 0.05f);
  base::Image table(2, 2, 1);
  table.pixels.assign(4, 0.4f);
  const Inputs inputs{.lut = &lut, .sheenTable = &table, .lights = {makeDirectional(towards, sun)}};
  for (const float roughness : {0.f, 0.3f, 1.f}) {
    const ShadedPoint layered = shade(makeLayered(0.5f, 0.5f, 0.3f, color, roughness), inputs, kPlain);
    const ShadedPoint base = shade(makeLayered(0.5f, 0, 0, glm::vec3(0), 0), inputs, kPlain);
    const tests::QuadCosines c(0.5f, towards);
    const double alpha = f64::sheenAlpha(roughness);
    const double lobe = f64::D_Charlie(alpha, c.NoH) * f64::V_Charlie(alpha, c.NoV, c.NoL) * c.NoL;
    const float belowCoat = 1 - 0.5f * (0.04f * 0.7f + 0.05f), belowSheen = 1 - 0.9f * 0.4f;
    expectNear(layered[Term::sheen], glm::vec3(belowCoat * lobe * glm::dvec3(color * sun)), 1e-3f, "sheen");
    expectNear(layered[Term::sunDiffuse], belowCoat * belowSheen * base[Term::sunDiffuse], 1e-5f, "below both");
    expectNear(layered[Term::emissive], belowCoat * base[Term::emissive], 1e-5f, "emitted light passes the fibres");
  }
}

// With balanced diffuse light and Kulla and Conty's compensation an even sky comes back whole from a white base,
// whatever lies over it: what a layer reflects is what those below it lose.
TEST_F(HighendTest, AWhiteFurnaceStaysWhiteUnderLayers) {
  const gpu::EnvironmentMaps sky = makeEvenSky(device());
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated), table = makeSheenTable(lut.width);
  const Inputs inputs{.environment = &sky, .lut = &lut, .sheenTable = &table};
  for (const float angle : {0.f, 0.8f, 1.3f})
    for (const float coat : {0.f, 0.5f, 1.f})
      for (const float sheen : {0.f, 0.6f})
        for (const float roughness : {0.3f, 0.9f}) {
          if (coat == 0 && sheen == 0) continue;
          scenes::Scene scene = makeLayered(angle, coat, roughness, glm::vec3(sheen), roughness);
          scene.materials[0].baseColor = glm::vec4(1);
          scene.materials[0].emissive = glm::vec3(0);
          const ShadedPoint point = shade(scene, inputs);
          EXPECT_NEAR(point.color.x, 1, 0.01f) << angle << " " << coat << " " << sheen << " " << roughness;
        }
}

TEST_F(HighendTest, TheCoatHasItsOwnNormal) {
  const gpu::EnvironmentMaps environment = tests::makeRedTowardsX(device());
  const base::Image lut = constantLut(0.5f, 0.1f), table(2, 2, 1);
  scenes::Scene scene = makeLayered(0, 1, 0.1f, glm::vec3(0), 0);
  const Inputs inputs{.environment = &environment, .lut = &lut, .sheenTable = &table};
  EXPECT_EQ(shade(scene, inputs, kPlain)[Term::coatSpecular].x, 0) << "the flat coat mirrors +Z";
  scene.images.push_back({"tilt", base::Image8(4, 4, 4, 0)});
  for (std::size_t i = 0; i < 16; ++i) { // 45 degrees towards +X: the mirror direction is +X
    std::uint8_t* texel = scene.images[0].pixels.pixels.data() + 4 * i;
    texel[0] = 218, texel[1] = 128, texel[2] = 218, texel[3] = 255;
  }
  scene.materials[0].coatNormalTexture.image = 0;
  scene.meshes[0].tangents.assign(4, glm::vec4(1, 0, 0, 1));
  const ShadedPoint tilted = shade(scene, inputs, kPlain);
  EXPECT_GT(tilted[Term::coatSpecular].x, 0.05f);
  EXPECT_EQ(tilted[Term::skySpecular].x, 0) << "the base keeps its own";
}

// The texels scale the factors: coat by R, its roughness by G, sheen's colour as sRGB, its roughness by A.
TEST_F(HighendTest, TexturesOfTheLayersScaleTheirFactors) {
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated), table = makeSheenTable(lut.width);
  const Inputs inputs{
      .lut = &lut, .sheenTable = &table, .lights = {makeDirectional(glm::vec3(0.5f, 0.3f, 1), glm::vec3(3))}};
  scenes::Scene textured = makeLayered(0.4f, 0.8f, 0.9f, glm::vec3(0.8f, 0.6f, 0.4f), 0.7f);
  textured.images.push_back({"all", base::Image8(2, 2, 4, 0)});
  for (std::size_t i = 0; i < 4; ++i) {
    std::uint8_t* texel = textured.images[0].pixels.pixels.data() + 4 * i;
    texel[0] = 102, texel[1] = 153, texel[2] = 204, texel[3] = 127;
  }
  scenes::Material& m = textured.materials[0];
  for (scenes::TextureSlot* slot :
       {&m.coatTexture, &m.coatRoughnessTexture, &m.sheenColorTexture, &m.sheenRoughnessTexture})
    slot->image = 0;
  const auto linear = [](int byte) { return static_cast<float>(f64::srgbToLinear(byte / 255.0)); };
  const scenes::Scene plain =
      makeLayered(0.4f, 0.8f * 0.4f, 0.9f * 0.6f,
                  glm::vec3(0.8f, 0.6f, 0.4f) * glm::vec3(linear(102), linear(153), linear(204)), 0.7f * 127 / 255);
  const ShadedPoint a = shade(textured, inputs), b = shade(plain, inputs);
  for (const Term term : {Term::coatSpecular, Term::sheen, Term::sunDiffuse})
    expectNear(a[term], b[term], 2e-3f, "textured");
}

// A scene with a coat has a shader of its own; what has none looks the same in it, to the bit.
TEST_F(HighendTest, MaterialsWithoutLayersAreTheSameBesideThem) {
  const gpu::EnvironmentMaps sky = makeEvenSky(device());
  const base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated), table = makeSheenTable(lut.width);
  scenes::Scene alone = makeLayered(0.7f, 0, 0, glm::vec3(0), 0), beside = alone;
  scenes::Material coated = alone.materials[0];
  coated.name = "coated";
  coated.coat = 1;
  coated.sheenColor = glm::vec3(1);
  beside.materials.push_back(coated);
  scenes::Mesh unseen = beside.meshes[0]; // no instance shows it
  unseen.material = 1;
  beside.meshes.push_back(unseen);
  ASSERT_TRUE(beside.hasLobes());
  Inputs inputs{.environment = &sky, .lut = &lut, .lights = {makeDirectional(glm::vec3(0.5f, 0.3f, 1), glm::vec3(3))}};
  const ShadedPoint a = shade(alone, inputs);
  inputs.sheenTable = &table;
  const ShadedPoint b = shade(beside, inputs);
  EXPECT_EQ(a.color, b.color);
  for (std::size_t t = 0; t < shading::kTermCount; ++t) EXPECT_EQ(a.terms[t], b.terms[t]) << shading::kTermNames[t];
}

} // namespace
} // namespace parity::highend
