// White furnaces with bodies: no light is made or lost on its way through, whatever is on the surface.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "reference/passed_through.h"

namespace parity::reference {
namespace {

class BodyEnergyTest : public PassedThroughTest {
protected:
  static scenes::Scene sphere() {
    scenes::Scene scene;
    tests::addObject(scene, scenes::makeSphere(0.5, 48, 24), glass());
    return scene;
  }
  static scenes::Scene box() {
    scenes::Scene scene;
    tests::addObject(scene, scenes::makeBox(glm::dvec3(-0.5), glm::dvec3(0.5)), glass());
    return scene;
  }
  static void addLayers(SurfaceSample& sample, int layers) {
    if ((layers & 1) != 0) sample.coat = 0.8f, sample.coatRoughness = 0.2f;
    if ((layers & 2) != 0) sample.sheenColor = glm::vec3(0.6f), sample.sheenRoughness = 0.4f;
    if ((layers & 4) != 0) sample.iridescence = 1, sample.filmThickness = 450;
    if ((layers & 8) != 0) {
      sample.anisotropy = 0.6f;
      sample.tangent = glm::normalize(glm::cross(sample.normal, glm::vec3(0.3f, 0.9f, 0.1f)));
    }
    if ((layers & 16) != 0) sample.dispersion = 3;
    if ((layers & 32) != 0) sample.transmission = 0.5f, sample.diffuseTransmission = 0.5f;
    // A normal map's normal.
    if ((layers & 64) != 0) sample.normal = glm::normalize(sample.normal + glm::vec3(0.3f, -0.2f, 0.1f));
  }
  static std::vector<SurfaceSample> samplesOf(const scenes::Scene& scene, const std::vector<int>& layers) {
    const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
    std::vector<SurfaceSample> samples;
    for (const float roughness : {0.f, 0.2f, 0.6f, 1.f})
      for (const int each : layers)
        for (const double offset : {0.03, 0.35, 0.48}) {
          SurfaceSample sample = surfaceOf(bodies, {offset * 0.8 - 1.2, offset * 0.6 - 0.2, -4},
                                           glm::normalize(glm::dvec3(0.3, 0.05, 1)), roughness);
          sample.pixel = static_cast<std::uint32_t>(samples.size());
          addLayers(sample, each);
          samples.push_back(sample);
        }
    return samples;
  }
  static double expectWhite(const std::vector<SurfaceSample>& samples, const Inputs& inputs, int bounces) {
    const auto shaded = shade(samples, inputs,
                              {.model = {},
                               .integral = {.relativeError = 1e-3, .minSamples = 256, .maxSamples = 1 << 14},
                               .bounces = bounces});
    double worst = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double off = sumOfTerms(shaded[i])[c] - 1;
        EXPECT_NEAR(off, 0, 2e-3 + 5 * shaded[i].standardError)
            << "point " << i << ", roughness " << samples[i].roughness << ", coat " << samples[i].coat << ", sheen "
            << samples[i].sheenColor.x << ", film " << samples[i].iridescence << ", anisotropy "
            << samples[i].anisotropy << ", dispersion " << samples[i].dispersion << ", transmission "
            << samples[i].transmission;
        EXPECT_LT(std::abs(off), 0.01) << i;
        worst = std::max(worst, std::abs(off));
      }
    return worst;
  }
};

TEST_F(BodyEnergyTest, WhiteFurnaceStaysWhite) {
  double worst = 0;
  std::size_t points = 0;
  for (const scenes::Scene& scene : {sphere(), box()}) {
    const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
    Inputs inputs = inputsOf(&white());
    inputs.bodies = &bodies;
    const auto samples = samplesOf(scene, {0, 1, 2, 3, 4, 8, 16, 31, 32, 63, 64});
    worst = std::max(worst, expectWhite(samples, inputs, 0));
    points += samples.size();
  }
  std::printf("bodies in a white furnace: %.1e off at worst, of %zu points\n", worst, points);
}

// Within glowing walls, with shadows: light that leaves a body is that of the surfaces.
TEST_F(BodyEnergyTest, WhiteStaysWhiteWhereRaysAreTraced) {
  scenes::Material walls = tests::matte("walls", 0, 1);
  walls.specular = 0;
  for (scenes::Scene scene : {sphere(), box()}) {
    tests::addObject(scene, tests::insideOfBox(6), walls);
    const SeenThrough rays(scene);
    Inputs inputs = inputsOf(nullptr);
    rays.giveShadowsTo(inputs);
    std::vector<SurfaceSample> samples;
    for (const SurfaceSample& sample : samplesOf(scene, {0, 3, 16, 32})) samples.push_back(sample);
    expectWhite(samples, inputs, 1);
  }
}

// The tint is the entry's: light is coloured once, however often it turns within.
TEST_F(BodyEnergyTest, BaseColorTintsOnce) {
  const scenes::Scene scene = box();
  const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
  Inputs inputs = inputsOf(&white());
  inputs.bodies = &bodies;
  for (const float roughness : {0.f, 0.5f}) {
    SurfaceSample sample = surfaceOf(bodies, {0.1, 0.2, -4}, {0, 0, 1}, roughness);
    const double whole = through(shadeOne(sample, inputs, {.relativeError = 1e-3})).x;
    sample.baseColor = {0.5f, 0.25f, 0};
    sample.occlusion = 0.5f;
    const ShadedSample tinted = shadeOne(sample, inputs, {.relativeError = 1e-3});
    EXPECT_NEAR(through(tinted).x, 0.25 * whole, 2e-3);
    EXPECT_NEAR(through(tinted).y, 0.125 * whole, 2e-3);
    EXPECT_EQ(through(tinted).z, 0);
  }
}

// Whatever a body may be, its normal turned away included.
TEST_F(BodyEnergyTest, NothingIsNanOrNegative) {
  const scenes::Scene scene = sphere();
  const SeenThrough rays(scene);
  Inputs inputs = inputsOf(&sunny(), {sunFrom({1, 0.01f, 0})});
  rays.giveTo(inputs);
  std::vector<SurfaceSample> samples;
  for (const float roughness : {0.f, 1e-3f, 1.1e-3f, 0.3f, 1.f})
    for (const float ior : {1.f, 1.0001f, 1.5f, 10.f})
      for (const double turn : {0.0, 1.5, 1.8})
        for (const float thickness : {0.f, 1.f})
          for (const float absorption : {0.f, 1e4f}) {
            SurfaceSample sample = surfaceOf(rays.bodies(), {0.2, 0.1, -4}, {0, 0, 1}, roughness);
            const glm::vec3 side = glm::normalize(glm::cross(sample.normal, glm::vec3(0, 1, 0)));
            sample.normal = glm::vec3(std::cos(turn)) * sample.normal + glm::vec3(std::sin(turn)) * side;
            sample.ior = ior;
            sample.thickness = thickness;
            sample.absorption = glm::vec3(absorption);
            sample.dispersion = 1;
            sample.transmission = 0.5f;
            sample.diffuseTransmission = 1;
            samples.push_back(sample);
          }
  for (const ShadedSample& result : shade(samples, inputs, {.model = {}, .integral = {.maxSamples = 256}})) {
    for (const glm::vec3& value : result.terms)
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(value[c]) && value[c] >= 0) << value[c];
    ASSERT_TRUE(std::isfinite(result.relativeError));
  }
}

} // namespace
} // namespace parity::reference
