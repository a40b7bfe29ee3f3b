// Points under a thin film: the table against the formula, and light against sums of it.
#include "reference/film_fresnel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

#include "reference/layered_point.h"
#include "shading/quadrature.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

glm::dvec3 filmBy(double ior, double nm, const glm::dvec3& F0, double VoH) {
  const shading::f64::real3 F = shading::f64::thinFilmFresnel(ior, nm, {F0.x, F0.y, F0.z}, VoH);
  return {F.x, F.y, F.z};
}

SurfaceSample iridescent(double NoV, float roughness, float metallic, float share = 1) {
  SurfaceSample sample = tests::makePoint(NoV, roughness, metallic);
  sample.baseColor = {0.9f, 0.6f, 0.3f};
  sample.iridescence = share;
  sample.filmIor = 1.4f;
  sample.filmThickness = 380;
  return sample;
}
// F of such a point.
glm::dvec3 fresnelOf(const SurfaceSample& s, double VoH) {
  const glm::dvec3 F0 = glm::dvec3(s.dielectricF0) * (1.0 - s.metallic) + glm::dvec3(s.baseColor) * double(s.metallic);
  const glm::dvec3 bare = F0 + (1.0 - F0) * std::pow(1 - VoH, 5);
  return glm::mix(bare, filmBy(s.filmIor, s.filmThickness, F0, VoH), double(s.iridescence));
}

class FilmTest : public LayersTest {};

TEST_F(FilmTest, TableIsTheFormula) {
  double worst = 0;
  for (const double ior : {1.0, 1.05, 1.3, 1.8, 2.5})
    for (const double nm : {0.0, 15.0, 200.0, 600.0, 1200.0, 1500.0, 3000.0})
      for (const glm::dvec3& F0 : {glm::dvec3(0.04), glm::dvec3(0.95, 0.64, 0.54), glm::dvec3(0, 0.2, 1)}) {
        const FilmFresnel film(ior, nm, F0);
        for (int i = 0; i <= 1000; ++i) {
          const glm::dvec3 error = glm::abs(film.at(i / 1000.0) - filmBy(ior, nm, F0, i / 1000.0));
          worst = std::max({worst, error.x, error.y, error.z});
        }
      }
  std::printf("table of films: %.1e off at worst\n", worst);
  EXPECT_LT(worst, 5e-4);
}

TEST_F(FilmTest, SunIsTheClosedForm) {
  const scenes::Light sun = sunFrom({0.3f, 0.8f, 0.4f});
  for (const float share : {0.3f, 1.f})
    for (const float roughness : {0.1f, 0.5f, 1.f}) {
      const SurfaceSample sample = iridescent(0.6, roughness, 0.25f, share);
      const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view)), L = -glm::dvec3(sun.direction),
                                         H = glm::normalize(V + L), F = fresnelOf(sample, glm::dot(V, H));
      const double alpha = double(roughness) * double(roughness), NoV = glm::dot(N, V);
      const double lobe = tests::distribution(alpha, glm::dot(N, H)) *
                          tests::maskingShadowing(tests::Geometry::heightCorrelated, alpha, NoV, glm::dot(N, L)) /
                          (4 * NoV);
      const DirectLight result = shadeDirect(sample, {sun}, tests::plainModel(), nullptr);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(result.sunSpecular[c], sun.color[c] * lobe * F[c], 1e-4 * sun.color[c] * lobe) << roughness;
    }
}

TEST_F(FilmTest, EnvironmentIsTheSumOverItsCells) {
  const scenes::Environment environment = tests::makeSunnyPanorama();
  for (const float roughness : {0.2f, 0.6f}) {
    const SurfaceSample sample = iridescent(0.4, roughness, 1);
    const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view));
    const double alpha = double(roughness) * double(roughness), NoV = glm::dot(N, V);
    glm::dvec3 sum(0);
    for (int y = 0; y < tests::kPanoramaHeight / 2; ++y)
      for (int x = 0; x < tests::kPanoramaWidth; ++x) {
        const float* cell = environment.radiance.at(x, y);
        const int sub = cell[1] > 10 ? 8 : 1;
        for (int k = 0; k < sub * sub; ++k) {
          const int i = k % sub, j = k / sub;
          const glm::dvec3 L = tests::cellDirection(x + (i + 0.5) / sub - 0.5, y + (j + 0.5) / sub - 0.5),
                           H = glm::normalize(V + L);
          const double top = pi * (y + double(j) / sub) / tests::kPanoramaHeight;
          const double area = (std::cos(top) - std::cos(top + pi / sub / tests::kPanoramaHeight)) * 2 * pi / sub /
                              tests::kPanoramaWidth;
          sum += glm::dvec3(cell[0], cell[1], cell[2]) * fresnelOf(sample, glm::dot(V, H)) *
                 (area * tests::distribution(alpha, glm::dot(N, H)) *
                  tests::maskingShadowing(tests::Geometry::heightCorrelated, alpha, NoV, glm::dot(N, L)) / (4 * NoV));
        }
      }
    const IntegralOptions exact{.relativeError = 3e-4, .minSamples = 1024, .maxSamples = 1 << 16};
    const Lobes lobes(sample, tests::plainModel(), roughness, nullptr);
    const Integral sky = integrateEnvironment(sample, lobes, sunny(), glm::dvec3(0), exact);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sky.specular[c], sum[c], 5 * sky.standardError[c] + 1e-3 * sum[c]) << roughness;
  }
}

TEST_F(FilmTest, MirrorShowsTheFilmAtItsAngle) {
  const SurfaceSample sample = iridescent(0.3, 0, 1);
  const Lobes lobes(sample, Model{}, 0, &albedo());
  const Integral result = integrateEnvironment(sample, lobes, white(), glm::dvec3(0), {});
  const glm::dvec3 F = fresnelOf(sample, sample.view.y);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(result.specular[c], F[c], 1e-6);
}

TEST_F(FilmTest, AFilmOfNoShareIsNone) {
  SurfaceSample film = iridescent(0.4, 0.5f, 0.5f, 0), bare = film;
  bare.filmIor = 1.3f;
  bare.filmThickness = 0;
  const Inputs inputs = inputsOf(&sunny(), {sunFrom({0.3f, 0.8f, 0.4f})});
  const ShadedSample a = shadeOne(film, inputs), b = shadeOne(bare, inputs);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  // A whole film without thickness is the bare surface of the same curve.
  bare.iridescence = 1;
  const ShadedSample thin = shadeOne(bare, inputs, {.relativeError = 5e-4, .minSamples = 2048});
  const ShadedSample none = shadeOne(film, inputs, {.relativeError = 5e-4, .minSamples = 2048});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sumOfTerms(thin)[c], sumOfTerms(none)[c], 3e-3 * sumOfTerms(none)[c]);
}

// What the film reflects the diffuse lobe does not get, channel by channel.
TEST_F(FilmTest, DiffuseLobeGetsWhatTheFilmLeaves) {
  for (const float roughness : {0.f, 0.1f, 0.5f, 1.f})
    for (const double NoV : {0.05, 0.5, 1.0}) {
      SurfaceSample sample = iridescent(NoV, roughness, 0);
      sample.baseColor = glm::vec3(1);
      const Integral result = integrateEnvironment(sample, Lobes(sample, Model{}, roughness, &albedo()), white(),
                                                   glm::dvec3(0), {.relativeError = 1e-4, .maxSamples = 1 << 16});
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR((result.diffuse + result.specular)[c], 1, 1e-3) << roughness << ", " << NoV;
    }
}

} // namespace
} // namespace parity::reference
