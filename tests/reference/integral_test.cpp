// Environments of known answers: furnaces, closed forms, mirrors, and whatever a material may hold.
#include "reference/environment_integral.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "reference/surroundings.h"

namespace parity::reference {
namespace {

IntegralOptions fixed(int samples, std::uint32_t seed = 0) {
  return {.relativeError = 0, .minSamples = samples, .maxSamples = samples, .seed = seed};
}

class IntegralTest : public testing::Test {
protected:
  static const DirectionalAlbedo& albedo(GeometryTerm term) {
    static const DirectionalAlbedo correlated(GeometryTerm::heightCorrelated), schlick(GeometryTerm::schlickSmith);
    return term == GeometryTerm::heightCorrelated ? correlated : schlick;
  }
  static const EnvironmentSampler& white() {
    static const EnvironmentSampler sampler(tests::makeWhitePanorama());
    return sampler;
  }
};

TEST_F(IntegralTest, WhiteMetalInAWhiteFurnaceIsWhiteToFourDigits) {
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith})
    for (const float roughness : {0.f, 0.02f, 0.1f, 0.25f, 0.5f, 0.75f, 1.f})
      for (const double NoV : {0.05, 0.4, 1.0}) {
        SurfaceSample sample = tests::makePoint(NoV, roughness, 1);
        const Lobes lobes(sample, Model{.surface = {.geometryTerm = term}}, roughness, &albedo(term));
        const Integral result = integrateEnvironment(sample, lobes, white(), glm::dvec3(0), fixed(1 << 16));
        EXPECT_NEAR(result.specular.x, 1, 1e-4) << "roughness " << roughness << ", NoV " << NoV;
        // The error it reports bounds what is left, but for the table's 1.5e-5: t of 15 degrees, 5 sigma.
        EXPECT_LT(std::abs(result.specular.x - 1), 5 * result.standardError.x + 3e-5);
        EXPECT_LT(result.standardError.x, 1e-4);
      }
}

// Diffuse light is what the specular lobe leaves: a white dielectric sends out all that it receives, and no more.
TEST_F(IntegralTest, WhiteDielectricInAWhiteFurnaceIsWhite) {
  for (const FresnelCurve curve : {FresnelCurve::schlick, FresnelCurve::dielectric}) {
    const Model model{.surface = {.fresnel = curve}};
    const DirectionalAlbedo table(model.surface.geometryTerm, curve);
    for (const float roughness : {0.f, 0.05f, 0.4f, 1.f})
      for (const double NoV : {0.05, 0.6}) {
        const SurfaceSample sample = tests::makePoint(NoV, roughness, 0);
        const Lobes lobes(sample, model, roughness, &table);
        const Integral result = integrateEnvironment(sample, lobes, white(), glm::dvec3(0), fixed(1 << 14));
        EXPECT_NEAR(result.diffuse.x + result.specular.x, 1, 5 * result.standardError.x + 3e-5)
            << "roughness " << roughness << ", NoV " << NoV;
        EXPECT_LT(result.standardError.x, 2e-4);
        EXPECT_GT(result.specular.x, 0.01);
      }
  }
}

// Without it, what is lost is 1 - E: height-correlated at roughness 1, E(1) = 1 - ln 2.
TEST_F(IntegralTest, SingleScatteringLosesWhatTheAlbedoSays) {
  const SurfaceSample sample = tests::makePoint(1, 1, 1);
  const Lobes lobes(sample, tests::plainModel(), 1, nullptr);
  const Integral result = integrateEnvironment(sample, lobes, white(), glm::dvec3(0), fixed(1 << 16));
  EXPECT_NEAR(result.specular.x, 1 - std::log(2.0), 1e-4);
}

// N = +Y, radiance 1 + y: irradiance / pi = 1 + 2/3. Cells of half a degree leave 1e-5.
TEST_F(IntegralTest, DiffuseUnderAConstantAndACosineIsTheClosedForm) {
  SurfaceSample sample = tests::makePoint(0.7, 0.5f, 0);
  sample.baseColor = {0.8f, 0.5f, 0.25f};
  const Lobes lobes(sample, tests::plainModel(), 0.5, nullptr);
  const EnvironmentSampler sky(tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(1 + d.y); }));
  const glm::dvec3 constant = integrateEnvironment(sample, lobes, white(), glm::dvec3(0), fixed(1 << 15)).diffuse;
  const glm::dvec3 cosine = integrateEnvironment(sample, lobes, sky, glm::dvec3(0), fixed(1 << 15)).diffuse;
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(constant[c], sample.baseColor[c], 1e-4 * sample.baseColor[c]);
    EXPECT_NEAR(cosine[c], sample.baseColor[c] * 5.0 / 3, 1e-4 * sample.baseColor[c]);
  }
}

TEST_F(IntegralTest, MirrorShowsTheEnvironmentTimesFresnel) {
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  for (const double NoV : {0.2, 0.9}) {
    SurfaceSample sample = tests::makePoint(NoV, 0, 1);
    sample.baseColor = {0.9f, 0.6f, 0.3f};
    const glm::dvec3 V = glm::normalize(glm::dvec3(sample.view)), R(-V.x, V.y, V.z);
    const glm::dvec3 seen = sky.evaluate(R).radiance;
    const Integral mirror = integrateEnvironment(sample, Lobes(sample, tests::plainModel(), 0, nullptr), sky,
                                                 glm::dvec3(0), IntegralOptions{});
    // Nearly a mirror: the lobe, of 0.02 degrees, stays within the sky's gradient.
    const Integral nearly = integrateEnvironment(sample, Lobes(sample, tests::plainModel(), 0.015, nullptr), sky,
                                                 glm::dvec3(0), fixed(1 << 12));
    for (int c = 0; c < 3; ++c) {
      const double F0 = sample.baseColor[c], F = F0 + (1 - F0) * std::pow(1 - V.y, 5);
      EXPECT_NEAR(mirror.specular[c], F * seen[c], 1e-7);
      EXPECT_NEAR(nearly.specular[c], F * seen[c], 5e-3 * F * seen[c]);
    }
    EXPECT_EQ(mirror.standardError, glm::dvec3(0));
    EXPECT_EQ(mirror.samples, 0);
  }
}

TEST_F(IntegralTest, StopsAtTheWantedErrorAndSaysWhatItReached) {
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  const SurfaceSample sample = tests::makePoint(0.6, 0.4f, 0);
  const Lobes lobes(sample, tests::plainModel(), 0.4, nullptr);
  int previous = 0;
  for (const double wanted : {0.02, 0.002, 0.0002}) {
    const Integral result = integrateEnvironment(sample, lobes, sky, glm::dvec3(0), {.relativeError = wanted});
    const glm::dvec3 color = result.diffuse + result.specular;
    EXPECT_LE(result.standardError.x, wanted * std::max({color.x, color.y, color.z}));
    EXPECT_GE(result.samples, previous);
    previous = result.samples;
  }
  EXPECT_GT(previous, 64);
  // At the most samples it stops, wherever it is.
  const Integral capped =
      integrateEnvironment(sample, lobes, sky, glm::dvec3(0), {.relativeError = 1e-9, .maxSamples = 1024});
  EXPECT_EQ(capped.samples, 1024);
  EXPECT_GT(capped.standardError.x, 0);
}

TEST_F(IntegralTest, NothingOfAnyMaterialIsNanOrNegative) {
  scenes::Environment environment = tests::makeSunnyPanorama();
  environment.radiance.pixels[3000] = 1e30f;
  const EnvironmentSampler sky(environment);
  std::vector<SurfaceSample> samples;
  for (const float roughness : {0.f, 1e-3f, 1.1e-3f, 0.01f, 0.5f, 1.f})
    for (const double NoV : {-1.0, -0.5, 0.0, 1e-6, 0.5, 1.0})
      for (const float metallic : {0.f, 0.5f, 1.f})
        for (const float level : {0.f, 1.f}) {
          SurfaceSample sample = tests::makePoint(NoV, roughness, metallic);
          sample.baseColor = glm::vec3(level);
          sample.dielectricF0 = glm::vec3(level);
          sample.dielectricF90 = level;
          samples.push_back(sample);
        }
  scenes::Light light;
  light.color = glm::vec3(1e6f);
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith}) {
    Options options;
    options.model.surface.geometryTerm = term;
    options.integral.maxSamples = 256;
    const Inputs inputs{.environment = &sky, .albedo = &albedo(term), .lights = {light}};
    for (const ShadedSample& result : shade(samples, inputs, options)) {
      for (const glm::vec3& value : result.terms)
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(value[c]) && value[c] >= 0) << value[c];
      ASSERT_TRUE(std::isfinite(result.relativeError));
    }
  }
}

TEST_F(IntegralTest, DoesNotDependOnThreadsOrNeighbours) {
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  std::vector<SurfaceSample> samples;
  for (std::uint32_t i = 0; i < 100; ++i) {
    SurfaceSample sample = tests::makePoint(0.1 + 0.008 * i, 0.01f * i, i % 3 * 0.5f);
    sample.pixel = i;
    samples.push_back(sample);
  }
  const Inputs inputs{.environment = &sky, .albedo = &albedo(GeometryTerm::heightCorrelated)};
  double told = 0;
  const auto all = shade(samples, inputs, {}, [&](double done) { told = done; });
  EXPECT_EQ(told, 1);
  const auto same = [](const ShadedSample& a, const ShadedSample& b) {
    return a.terms == b.terms && a.standardError == b.standardError && a.samples == b.samples;
  };
  for (const int threads : {1, 3}) {
    const base::ThreadLimit limit(threads);
    const auto again = shade(samples, inputs, {});
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_TRUE(same(all[i], again[i])) << i << ", " << threads;
  }
  const auto alone = shade(std::span(samples).subspan(57, 1), inputs, {});
  EXPECT_TRUE(same(alone[0], all[57]));
}

TEST_F(IntegralTest, OcclusionDimsTheSkyAloneAndUnlitShowsItsColour) {
  SurfaceSample sample = tests::makePoint(0.8, 0.6f, 0), dimmed = sample, unlit = sample;
  dimmed.occlusion = 0.25f;
  unlit.unlit = 1;
  unlit.baseColor = {0.1f, 0.2f, 0.3f};
  sample.emissive = dimmed.emissive = glm::vec3(0.5f);
  scenes::Light sun;
  sun.kind = scenes::LightKind::directional;
  sun.direction = {0, -1, 0};
  const Inputs inputs{.environment = &white(), .albedo = &albedo(GeometryTerm::heightCorrelated), .lights = {sun}};
  Options options;
  options.integral = fixed(1024);
  const auto results = shade(std::array{sample, dimmed, unlit}, inputs, options);
  using shading::Term;
  const auto term = [&](std::size_t i, Term t) { return results[i].terms[static_cast<std::size_t>(t)].x; };
  for (const Term t : {Term::skyDiffuse, Term::skySpecular}) EXPECT_FLOAT_EQ(term(1, t), 0.25f * term(0, t));
  for (const Term t : {Term::sunDiffuse, Term::sunSpecular, Term::emissive}) EXPECT_EQ(term(1, t), term(0, t));
  EXPECT_EQ(results[2].terms[static_cast<std::size_t>(Term::emissive)], unlit.baseColor);
  EXPECT_EQ(term(2, Term::skyDiffuse), 0);
}

} // namespace
} // namespace parity::reference
