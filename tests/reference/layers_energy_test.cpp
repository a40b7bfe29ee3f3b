// A clear coat over a sheen over the base: no light is made or lost, and errors are as large as they say.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "reference/layered_point.h"
#include "shading/quadrature.h"
#include "support/matte_scenes.h"

namespace parity::reference {
namespace {

// A white base under grey layers sends out all that it receives, and a black one no more.
TEST_F(LayersTest, WhiteFurnaceStaysWhite) {
  std::vector<SurfaceSample> samples;
  std::vector<int> bases;
  for (const float coat : {0.f, 0.5f, 1.f})
    for (const float coatRoughness : {0.f, 0.1f, 0.5f, 1.f})
      for (const float sheen : {0.f, 0.5f, 1.f})
        for (const float sheenRoughness : {0.1f, 0.5f, 1.f}) {
          if ((coat == 0 && coatRoughness > 0) || (sheen == 0 && sheenRoughness < 1)) continue; // the same again
          for (const int base : {0, 1, 2}) // white dielectric, white metal, black
            for (const double NoV : {0.1, 0.5, 1.0}) {
              SurfaceSample sample = tests::makePoint(NoV, 0.4f, base == 1 ? 1 : 0);
              sample.pixel = static_cast<std::uint32_t>(samples.size());
              if (base == 2) sample.baseColor = sample.dielectricF0 = glm::vec3(0), sample.dielectricF90 = 0;
              sample.coat = coat;
              sample.coatRoughness = coatRoughness;
              sample.coatNormal = sample.normal;
              sample.sheenColor = glm::vec3(sheen);
              sample.sheenRoughness = sheenRoughness;
              samples.push_back(sample);
              bases.push_back(base);
            }
        }
  const auto shaded =
      shade(samples, inputsOf(&white()),
            {.model = {}, .integral = {.relativeError = 2e-4, .minSamples = 128, .maxSamples = 1 << 15}});
  double worst = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double color = sumOfTerms(shaded[i]).y;
    SCOPED_TRACE(testing::Message() << "coat " << samples[i].coat << " of roughness " << samples[i].coatRoughness
                                    << ", sheen " << samples[i].sheenColor.y << " of " << samples[i].sheenRoughness
                                    << ", base " << bases[i] << ", NoV " << samples[i].view.y);
    if (bases[i] < 2) {
      EXPECT_NEAR(color, 1, 1e-3);
      worst = std::max(worst, std::abs(color - 1));
    } else {
      EXPECT_TRUE(color >= 0 && color <= 1 + 1e-3) << color;
    }
  }
  std::printf("white furnace: %.1e off at worst, of %zu\n", worst, samples.size());
}

// The same with rays: in a box of glowing walls every direction shows 1, and above an object that hides nothing the
// white sky does. Layers are sampled another way there.
TEST_F(LayersTest, WhiteStaysWhiteWhereRaysAreTraced) {
  scenes::Scene box, below;
  scenes::Material walls = tests::matte("walls", 0, 1);
  walls.specular = 0;
  tests::addObject(box, tests::insideOfBox(2), walls);
  tests::addObject(below, tests::insideOfBox(0.5f), walls);
  const lighting::Visibility inBox(box), open(below);
  const lighting::SurfaceLight surfaces(box);
  const lighting::Emitters emitters(box, surfaces);
  for (const float coatRoughness : {0.f, 0.2f, 0.8f})
    for (const float sheenRoughness : {0.1f, 0.3f, 0.9f}) {
      SurfaceSample sample = tests::makePoint(0.15, 0.4f, 0);
      sample.geometricNormal = sample.normal;
      sample.coat = 0.8f;
      sample.coatRoughness = coatRoughness;
      sample.coatNormal = sample.normal;
      sample.sheenColor = glm::vec3(0.9f);
      sample.sheenRoughness = sheenRoughness;
      SCOPED_TRACE(testing::Message() << "coat " << coatRoughness << ", sheen " << sheenRoughness);
      const IntegralOptions integral{.relativeError = 1e-3, .minSamples = 256, .maxSamples = 1 << 14};
      Inputs inputs = inputsOf(nullptr);
      inputs.visibility = &inBox;
      inputs.surfaces = &surfaces;
      inputs.emitters = &emitters;
      const ShadedSample glowing =
          shade({&sample, 1}, inputs, {.model = {}, .integral = integral, .bounces = 1}).front();
      EXPECT_NEAR(sumOfTerms(glowing).y, 1, 5 * glowing.standardError + 1e-4);
      EXPECT_LT(glowing.standardError, 4e-3);
      EXPECT_GT(layerTerm(glowing, Term::sheen).y, 0.02);
      EXPECT_GT(layerTerm(glowing, Term::coatSpecular).y, 0.02);
      sample.position = {0, 5, 0};
      inputs = inputsOf(&white());
      inputs.visibility = &open;
      const ShadedSample sky = shadeOne(sample, inputs, integral);
      EXPECT_NEAR(sumOfTerms(sky).y, 1, 5 * sky.standardError + 1e-4);
      EXPECT_LT(sky.standardError, 4e-3);
    }
}

// The coat lobe and Ecoat belong together: what the coat sends out is what the rest loses.
TEST_F(LayersTest, CoatSendsOutItsAlbedo) {
  for (const float roughness : {0.f, 0.1f, 0.5f, 1.f})
    for (const double NoV : {0.05, 0.4, 1.0}) {
      SurfaceSample sample = layered();
      sample.view = tests::makePoint(NoV, 0, 0).view;
      sample.baseColor = sample.dielectricF0 = sample.sheenColor = glm::vec3(0);
      sample.coatNormal = sample.normal;
      sample.coatRoughness = roughness;
      const ShadedSample shaded =
          shadeOne(sample, inputsOf(&white()), {.relativeError = 0, .minSamples = 1 << 13, .maxSamples = 1 << 13});
      double expected = 0.04 + 0.96 * std::pow(1 - NoV, 5);
      if (roughness > 0) {
        const auto E = tests::integrateEnvBrdf(tests::Geometry::heightCorrelated, roughness, NoV);
        expected = 0.04 * E.A + E.B;
      }
      EXPECT_NEAR(coatAlbedo(sample, {}, &albedo()), expected, 3e-5) << roughness << ", " << NoV;
      EXPECT_NEAR(layerTerm(shaded, Term::coatSpecular).y, sample.coat * expected, 5 * shaded.standardError + 5e-5)
          << roughness << ", " << NoV;
    }
}

// The error that is reported is the error that is there, of all layers: z^2 of 30 degrees of freedom averages 1.07.
TEST_F(LayersTest, ErrorsAreHonest) {
  double squares = 0, worst = 0, relative2 = 0;
  constexpr int kPoints = 96;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    SurfaceSample sample = layered();
    sample.pixel = i;
    sample.view = tests::makePoint(0.1 + 0.9 * (i % 12) / 12, 0, 0).view;
    sample.sheenRoughness = 0.1f + 0.9f * static_cast<float>(i % 10) / 10.f;
    sample.coatRoughness = 0.05f + 0.9f * static_cast<float>(i % 7) / 7.f;
    sample.emissive = glm::vec3(0);
    const auto at = [&](std::uint32_t seed, double wanted, int least, int most) {
      return shadeOne(sample, inputsOf(&sunny()),
                      {.relativeError = wanted, .minSamples = least, .maxSamples = most, .seed = seed});
    };
    const ShadedSample a = at(1, 0, 256, 256), b = at(2, 0, 256, 256), stopped = at(3, 0.01, 64, 1 << 16);
    const double z = (sumOfTerms(a).x - sumOfTerms(b).x) / std::hypot(a.standardError, b.standardError);
    ASSERT_NE(z, 0);
    squares += z * z;
    worst = std::max(worst, std::abs(z));
    EXPECT_LE(stopped.relativeError, 0.01f);
    relative2 += std::pow(sumOfTerms(stopped).x / sumOfTerms(at(4, 0, 4096, 4096)).x - 1, 2);
  }
  // The red channel is not always the worst one.
  EXPECT_TRUE(squares / kPoints > 0.5 && squares / kPoints < 1.6) << squares / kPoints;
  EXPECT_LT(worst, 5.5);
  EXPECT_LT(std::sqrt(relative2 / kPoints), 0.01) << "that was wanted";
}

} // namespace
} // namespace parity::reference
