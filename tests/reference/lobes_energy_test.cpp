// Anisotropy and thin films with all layers and roughnesses: no light is made or lost, and errors are as large as they
// say.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "reference/layered_point.h"
#include "support/matte_scenes.h"

namespace parity::reference {
namespace {

class LobesEnergyTest : public LayersTest {
protected:
  static SurfaceSample point(double NoV, float roughness, float metallic, float anisotropy, float film) {
    SurfaceSample sample = tests::makePoint(NoV, roughness, metallic);
    sample.anisotropy = anisotropy;
    sample.tangent = glm::normalize(glm::vec3(0.8f, 0, 0.6f));
    sample.iridescence = film;
    sample.filmThickness = 450;
    sample.coatNormal = sample.normal;
    return sample;
  }
};

// White metals and white dielectrics, bare, coated, with a sheen, and both.
TEST_F(LobesEnergyTest, WhiteFurnaceStaysWhite) {
  std::vector<SurfaceSample> samples;
  for (const float roughness : {0.f, 0.1f, 0.4f, 1.f})
    for (const float anisotropy : {0.f, 0.3f, 0.7f, 1.f})
      for (const float film : {0.f, 0.5f, 1.f})
        for (const float metallic : {0.f, 1.f})
          for (const int layers : {0, 1, 2, 3})
            for (const double NoV : {0.1, 0.7}) {
              if (anisotropy == 0 && film == 0) continue; // layers_energy_test.cpp
              SurfaceSample sample = point(NoV, roughness, metallic, anisotropy, film);
              sample.pixel = static_cast<std::uint32_t>(samples.size());
              if ((layers & 1) != 0) sample.coat = 0.8f, sample.coatRoughness = 0.2f;
              if ((layers & 2) != 0) sample.sheenColor = glm::vec3(0.6f), sample.sheenRoughness = 0.4f;
              samples.push_back(sample);
            }
  // Few points of a lobe that is all but a line may agree by chance.
  const auto shaded =
      shade(samples, inputsOf(&white()),
            {.model = {}, .integral = {.relativeError = 4e-4, .minSamples = 1024, .maxSamples = 1 << 14}});
  double worst = 0, squares = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double off = sumOfTerms(shaded[i])[c] - 1;
      EXPECT_NEAR(off, 0, 1e-3 + 5 * shaded[i].standardError)
          << "roughness " << samples[i].roughness << ", anisotropy " << samples[i].anisotropy << ", film "
          << samples[i].iridescence << ", metallic " << samples[i].metallic << ", coat " << samples[i].coat
          << ", sheen " << samples[i].sheenColor.y << ", NoV " << samples[i].view.y << ", channel " << c << ", error "
          << shaded[i].standardError;
      EXPECT_LT(std::abs(off), 0.01);
      worst = std::max(worst, std::abs(off));
      squares += off * off;
    }
  std::printf("white furnace: rms %.1e, %.1e off at worst, of %zu points\n",
              std::sqrt(squares / (3.0 * static_cast<double>(samples.size()))), worst, samples.size());
}

// The other geometry term and another curve of Fresnel's, at grazing views, too.
TEST_F(LobesEnergyTest, WhiteFurnaceStaysWhiteForTheOtherModel) {
  const shading::SurfaceModel surface{.geometryTerm = GeometryTerm::schlickSmith, .fresnel = FresnelCurve::dielectric};
  const DirectionalAlbedo table(surface.geometryTerm, surface.fresnel);
  for (const float roughness : {0.1f, 0.5f})
    for (const float anisotropy : {0.f, 0.6f})
      for (const float film : {0.f, 1.f})
        for (const float metallic : {0.f, 1.f})
          for (const double NoV : {0.03, 0.6}) {
            const SurfaceSample sample = point(NoV, roughness, metallic, anisotropy, film);
            const Lobes lobes(sample, Model{.surface = surface}, roughness, &table);
            const Integral light = integrateEnvironment(sample, lobes, white(), glm::dvec3(0),
                                                        {.relativeError = 2e-4, .maxSamples = 1 << 15});
            for (int c = 0; c < 3; ++c)
              EXPECT_NEAR((light.diffuse + light.specular)[c], 1, 1e-3 + 5 * light.standardError[c])
                  << roughness << ", " << anisotropy << ", " << film << ", " << metallic << ", " << NoV;
          }
}

// The same with rays, within glowing walls: bounced light and horizons take the lobe apart in other places.
TEST_F(LobesEnergyTest, WhiteStaysWhiteWhereRaysAreTraced) {
  scenes::Scene box;
  scenes::Material walls = tests::matte("walls", 0, 1);
  walls.specular = 0;
  tests::addObject(box, tests::insideOfBox(2), walls);
  const lighting::Visibility inBox(box);
  const lighting::SurfaceLight surfaces(box);
  const lighting::Emitters emitters(box, surfaces);
  Inputs inputs = inputsOf(nullptr);
  inputs.visibility = &inBox;
  inputs.surfaces = &surfaces;
  inputs.emitters = &emitters;
  for (const float anisotropy : {0.f, 0.8f})
    for (const float film : {0.f, 1.f})
      for (const float metallic : {0.f, 1.f}) {
        SurfaceSample sample = point(0.4, 0.4f, metallic, anisotropy, film);
        for (const bool tilted : {false, true}) {
          sample.geometricNormal = tilted ? glm::normalize(glm::vec3(-0.3f, 1, 0.2f)) : sample.normal;
          if (tilted && metallic == 0) continue; // the diffuse lobe loses what is below the horizon
          const ShadedSample glowing =
              shade({&sample, 1}, inputs,
                    {.model = {}, .integral = {.relativeError = 1e-3, .maxSamples = 1 << 14}, .bounces = 1})
                  .front();
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sumOfTerms(glowing)[c], 1, 5 * glowing.standardError + 1.5e-3)
                << anisotropy << ", " << film << ", " << metallic << ", " << tilted;
        }
      }
}

// z^2 of 30 degrees of freedom averages 1.07.
TEST_F(LobesEnergyTest, ErrorsAreHonest) {
  double squares = 0, worst = 0;
  constexpr int kPoints = 96;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    SurfaceSample sample =
        point(0.1 + 0.9 * (i % 12) / 12, 0.1f + 0.9f * static_cast<float>(i % 7) / 7.f, i % 2 == 0 ? 1.f : 0.f,
              static_cast<float>(i % 5) / 4.f, static_cast<float>(i % 3) / 2);
    sample.pixel = i;
    const Lobes lobes(sample, Model{}, sample.roughness, &albedo());
    const auto at = [&](std::uint32_t seed) {
      return integrateEnvironment(sample, lobes, sunny(), glm::dvec3(0),
                                  {.relativeError = 0, .minSamples = 1024, .maxSamples = 1024, .seed = seed});
    };
    const Integral a = at(1), b = at(2);
    const double z = (a.specular.y - b.specular.y) / std::hypot(a.standardError.y, b.standardError.y);
    squares += z * z;
    worst = std::max(worst, std::abs(z));
  }
  EXPECT_TRUE(squares / kPoints > 0.5 && squares / kPoints < 1.7) << squares / kPoints;
  EXPECT_LT(worst, 5.5);
}

// The coat and the sheen have neither.
TEST_F(LobesEnergyTest, LayersAboveTheBaseHaveNeither) {
  SurfaceSample sample = layered();
  sample.anisotropy = 0.8f;
  sample.tangent = {1, 0, 0};
  sample.iridescence = 1;
  sample.filmThickness = 400;
  for (const Layer& layer : layersOf(sample, {}, {&albedo(), &sheenAlbedo()})) {
    const Lobes lobes = lobesOf(layer, &albedo());
    EXPECT_EQ(lobes.isStretched(), layer.kind == LayerKind::base);
    EXPECT_EQ(lobes.hasFilm(), layer.kind == LayerKind::base);
  }
}

} // namespace
} // namespace parity::reference
