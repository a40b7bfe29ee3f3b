// A clear coat over a sheen over the base: light, order and weights, against formulas that are written out here.
#include "reference/layers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "reference/layered_point.h"
#include "shading/quadrature.h"
#include "shading/sheen_formula.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

// Suns and lamps, each layer's formula written out.
TEST_F(LayersTest, DirectLightIsTheClosedFormOfEachLayer) {
  const SurfaceSample sample = layered();
  scenes::Light sun = sunFrom({0.3f, 0.8f, 0.4f});
  sun.specularScale = 0.5f;
  const ShadedSample shaded = shadeOne(sample, inputsOf(nullptr, {sun}));
  SurfaceSample bare = sample;
  bare.coat = 0;
  bare.sheenColor = glm::vec3(0);
  const ShadedSample base = shadeOne(bare, inputsOf(nullptr, {sun}));

  const glm::dvec3 V = glm::normalize(glm::dvec3(sample.view)), L = -glm::dvec3(sun.direction);
  const glm::dvec3 H = glm::normalize(V + L), N(sample.normal), C = glm::normalize(glm::dvec3(sample.coatNormal));
  const double alpha = double(sample.coatRoughness) * double(sample.coatRoughness), NoV = glm::dot(C, V);
  const double F = 0.04 + 0.96 * std::pow(1 - glm::dot(V, H), 5);
  const double coat = tests::distribution(alpha, glm::dot(C, H)) * F / (4 * NoV) *
                      tests::maskingShadowing(tests::Geometry::heightCorrelated, alpha, NoV, glm::dot(C, L));
  const auto E = tests::integrateEnvBrdf(tests::Geometry::heightCorrelated, sample.coatRoughness, NoV);
  const double underCoat = 1 - sample.coat * (0.04 * E.A + E.B);
  const tests::SheenFormula formula(sample.sheenRoughness);
  const double NoL = glm::dot(N, L);
  const double sheen = formula.D(glm::dot(N, H)) * formula.V(glm::dot(N, V), NoL) * NoL;
  const double underSheen = underCoat * (1 - 0.8f * sheenAlbedo().at(sample.sheenRoughness, glm::dot(N, V)));
  for (int c = 0; c < 3; ++c) {
    const double lux = sun.color[c];
    EXPECT_NEAR(layerTerm(shaded, Term::coatSpecular)[c] / (sample.coat * coat * lux * 0.5), 1, 1e-5);
    EXPECT_NEAR(layerTerm(shaded, Term::sheen)[c] / (underCoat * sample.sheenColor[c] * sheen * lux * 0.5), 1, 1e-5);
    EXPECT_NEAR(layerTerm(shaded, Term::sunDiffuse)[c] / layerTerm(base, Term::sunDiffuse)[c], underSheen, 1e-5);
    EXPECT_NEAR(layerTerm(shaded, Term::sunSpecular)[c] / layerTerm(base, Term::sunSpecular)[c], underSheen, 1e-5);
    EXPECT_NEAR(layerTerm(shaded, Term::emissive)[c], underCoat * sample.emissive[c], 1e-5) << "no sheen dims it";
  }
  EXPECT_EQ(layerTerm(shaded, Term::localSpecular), glm::dvec3(0));
}

// The environment's light by the coat, over every cell of a panorama with a bright source.
TEST_F(LayersTest, CoatReflectsTheEnvironmentAboutItsOwnNormal) {
  const scenes::Environment environment = tests::makeSunnyPanorama();
  SurfaceSample sample = layered();
  sample.occlusion = 0.75f;
  for (const float roughness : {0.2f, 0.6f}) {
    sample.coatRoughness = roughness;
    const glm::dvec3 C = glm::normalize(glm::dvec3(sample.coatNormal)), V = glm::normalize(glm::dvec3(sample.view));
    const double alpha = double(roughness) * double(roughness), NoV = glm::dot(C, V);
    double sum = 0;
    for (int y = 0; y < tests::kPanoramaHeight; ++y)
      for (int x = 0; x < tests::kPanoramaWidth; ++x) {
        const double radiance = environment.radiance.at(x, y)[1];
        const int sub = radiance > 10 ? 8 : 1;
        for (int k = 0; k < sub * sub; ++k) {
          const double i = k % sub, j = k / sub; // NOLINT(bugprone-integer-division): the row
          const glm::dvec3 L = tests::cellDirection(x + (i + 0.5) / sub - 0.5, y + (j + 0.5) / sub - 0.5);
          const double NoL = glm::dot(C, L);
          if (!(NoL > 0)) continue;
          const double top = pi * (y + j / sub) / tests::kPanoramaHeight;
          const double area = (std::cos(top) - std::cos(top + pi / sub / tests::kPanoramaHeight)) * 2 * pi / sub /
                              tests::kPanoramaWidth;
          const glm::dvec3 H = glm::normalize(V + L);
          const double F = 0.04 + 0.96 * std::pow(1 - glm::dot(V, H), 5);
          sum += radiance * area * F * tests::distribution(alpha, glm::dot(C, H)) *
                 tests::maskingShadowing(tests::Geometry::heightCorrelated, alpha, NoV, NoL) / (4 * NoV);
        }
      }
    const ShadedSample shaded =
        shadeOne(sample, inputsOf(&sunny()), {.relativeError = 2e-4, .minSamples = 1024, .maxSamples = 1 << 16});
    const double expected = 0.75 * sample.coat * sum;
    EXPECT_NEAR(layerTerm(shaded, Term::coatSpecular).y, expected, 5 * shaded.standardError + 1e-3 * expected)
        << roughness << ", error " << shaded.standardError;
  }
}

// Each layer's environment light is that of the layer alone, at its weight.
TEST_F(LayersTest, LayersAddUpAtTheirWeights) {
  const SurfaceSample sample = layered();
  const IntegralOptions exact{.relativeError = 2e-4, .minSamples = 1024, .maxSamples = 1 << 16};
  const ShadedSample shaded = shadeOne(sample, inputsOf(&sunny()), exact);
  glm::dvec3 expected = emissionWeight(sample, {}, &albedo()) * glm::dvec3(sample.emissive);
  for (const Layer& layer : layersOf(sample, {}, {&albedo(), &sheenAlbedo()})) {
    const Integral sky = integrateEnvironment(layer.sample, lobesOf(layer, &albedo()), sunny(), glm::dvec3(0), exact);
    expected += layer.weight * (sky.diffuse + sky.specular);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sumOfTerms(shaded)[c], expected[c], 1e-3 * expected[c]);
  EXPECT_GT(layerTerm(shaded, Term::sheen).x, 0.01);
  EXPECT_GT(layerTerm(shaded, Term::coatSpecular).x, 0.005);
}

TEST_F(LayersTest, WithoutCoatAndSheenNothingChanges) {
  SurfaceSample bare = layered();
  bare.coat = 0;
  bare.sheenColor = glm::vec3(0);
  SurfaceSample plain = bare;
  plain.coatRoughness = plain.sheenRoughness = 0;
  plain.coatNormal = {0, 0, 1};
  Inputs inputs = inputsOf(&sunny(), {sunFrom({0.3f, 0.8f, 0.4f})});
  const ShadedSample a = shadeOne(bare, inputs);
  inputs.sheenAlbedo = nullptr;
  const ShadedSample b = shadeOne(plain, inputs);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  // The base's share of a layered point goes with its weight, and ends where the layers do.
  SurfaceSample thin = bare;
  thin.coat = 1e-6f;
  thin.sheenColor = glm::vec3(1e-6f);
  const glm::dvec3 almost = sumOfTerms(shadeOne(thin, inputsOf(&sunny(), inputs.lights), {.relativeError = 1e-3}));
  const glm::dvec3 none = sumOfTerms(shadeOne(bare, inputs, {.relativeError = 1e-3}));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(almost[c], none[c], 5e-3 * none[c]);
}

TEST_F(LayersTest, UnlitPointsHaveNoLayers) {
  SurfaceSample sample = layered();
  sample.unlit = 1;
  const ShadedSample shaded = shadeOne(sample, inputsOf(&sunny(), {sunFrom({0, 1, 0})}));
  EXPECT_EQ(layerTerm(shaded, Term::emissive), glm::dvec3(sample.baseColor));
  EXPECT_EQ(sumOfTerms(shaded), glm::dvec3(sample.baseColor));
}

// White sheen at a grazing view takes everything: the base is not integrated, and nothing is negative.
TEST_F(LayersTest, SheenThatTakesAllLeavesNothingBelow) {
  SurfaceSample sample = layered();
  sample.coat = 0;
  sample.sheenColor = glm::vec3(1);
  sample.sheenRoughness = 0.07f;
  sample.view = tests::makePoint(0.01, 0, 0).view;
  const auto layers = layersOf(sample, {}, {&albedo(), &sheenAlbedo()});
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers.front().kind, LayerKind::sheen);
  const ShadedSample shaded = shadeOne(sample, inputsOf(&sunny()));
  EXPECT_EQ(layerTerm(shaded, Term::skyDiffuse), glm::dvec3(0));
  EXPECT_GT(layerTerm(shaded, Term::sheen).x, 0);
}

// Whatever a coat may hold, its normal turned away included.
TEST_F(LayersTest, NothingOfAnyLayerIsNanOrNegative) {
  std::vector<SurfaceSample> samples;
  for (const float roughness : {0.f, 1e-3f, 1.1e-3f, 0.3f, 1.f})
    for (const double NoV : {-1.0, 0.0, 1e-6, 0.5, 1.0})
      for (const glm::vec3& coatNormal : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(-0.99f, 0.14f, 0)})
        for (const float level : {0.f, 1.f}) {
          SurfaceSample sample = tests::makePoint(NoV, roughness, level);
          sample.coat = 1;
          sample.coatRoughness = roughness;
          sample.coatNormal = coatNormal;
          sample.sheenColor = glm::vec3(level, 0.5f, 1);
          sample.sheenRoughness = roughness;
          samples.push_back(sample);
        }
  const auto shaded = shade(samples, inputsOf(&sunny(), {sunFrom({1, 0.01f, 0}), sunFrom({0, 1, 0})}),
                            {.model = {}, .integral = {.maxSamples = 256}});
  for (const ShadedSample& result : shaded) {
    for (const glm::vec3& value : result.terms)
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(value[c]) && value[c] >= 0) << value[c];
    ASSERT_TRUE(std::isfinite(result.relativeError));
  }
}

} // namespace
} // namespace parity::reference
