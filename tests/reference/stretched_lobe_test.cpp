// Anisotropic points: directions against their density, albedo against a dense sum, light against the formulas written
// out here, and the round lobe where the stretch ends.
#include "reference/stretched_lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <random>

#include "reference/direction_density.h"
#include "reference/layered_point.h"
#include "reference/reflection.h"
#include "reference/view_albedo.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

glm::dvec3 viewAlong(double NoV, double phi) {
  const double sine = std::sqrt((1 - NoV) * (1 + NoV));
  return {sine * std::cos(phi), sine * std::sin(phi), NoV};
}

// N = +Y, V leaning to +X; the tangent turned from X towards Z.
SurfaceSample brushed(double NoV, float roughness, float metallic, float anisotropy, double turn) {
  SurfaceSample sample = tests::makePoint(NoV, roughness, metallic);
  sample.baseColor = {0.9f, 0.6f, 0.3f};
  sample.anisotropy = anisotropy;
  sample.tangent = glm::vec3(std::cos(turn), 0, std::sin(turn));
  return sample;
}

// f cos at F = 1 by the textbook: Burley's D, and Heitz's Lambda or Schlick and Smith's G1.
double textbook(const SurfaceSample& sample, const glm::dvec3& L, GeometryTerm term) {
  const glm::dvec3 N(sample.normal), T(sample.tangent),
      B = glm::cross(N, T), V = glm::normalize(glm::dvec3(sample.view)), H = glm::normalize(V + L);
  const double s = sample.anisotropy, aB = double(sample.roughness) * double(sample.roughness);
  const double aT = aB + (1 - aB) * s * s;
  const double NoV = glm::dot(N, V), NoL = glm::dot(N, L);
  const double w = std::pow(glm::dot(T, H) / aT, 2) + std::pow(glm::dot(B, H) / aB, 2) + std::pow(glm::dot(N, H), 2);
  const double D = 1 / (pi * aT * aB * w * w);
  const auto slope2 = [&](const glm::dvec3& v) {
    return std::pow(aT * glm::dot(T, v), 2) + std::pow(aB * glm::dot(B, v), 2);
  };
  double G = 0;
  if (term == GeometryTerm::heightCorrelated) {
    const auto lambda = [&](const glm::dvec3& v) {
      return 0.5 * (std::sqrt(1 + slope2(v) / std::pow(glm::dot(N, v), 2)) - 1);
    };
    G = 1 / (1 + lambda(V) + lambda(L));
  } else {
    const auto masking = [&](const glm::dvec3& v) {
      const double x = glm::dot(N, v), k = 0.5 * std::sqrt(slope2(v) / (1 - x * x));
      return x / (x * (1 - k) + k);
    };
    G = masking(V) * masking(L);
  }
  return D * G / (4 * NoV) * (NoL > 0 ? 1 : 0);
}
double schlickAt(const SurfaceSample& sample, const glm::dvec3& L, int c) {
  const glm::dvec3 V = glm::normalize(glm::dvec3(sample.view)), H = glm::normalize(V + L);
  const double F0 = 0.04 * (1 - sample.metallic) + sample.baseColor[c] * sample.metallic;
  return F0 + (1 - F0) * std::pow(1 - glm::dot(V, H), 5);
}

class StretchedLobeTest : public LayersTest {};

TEST_F(StretchedLobeTest, DirectionsFollowTheirDensity) {
  for (const float anisotropy : {0.4f, 1.f})
    for (const double NoV : {0.15, 0.6, 1.0})
      for (const double phi : {0.0, 0.7}) {
        const Lobes lobes(brushed(0.5, 0.45f, 1, anisotropy, 0), tests::plainModel(), 0.45, nullptr);
        const glm::dvec3 view = viewAlong(NoV, phi), below(0, 0, -1);
        const auto pdf = [&](const glm::dvec3& l) { return lobes.evaluate(view, l, {}).pdfSpecular; };
        const auto sample = [&](const glm::dvec2& u) { return lobes.sampleSpecular(view, u).value_or(below); };
        std::mt19937_64 random(2);
        std::uniform_real_distribution<double> uniform;
        double upward = 0;
        for (int i = 0; i < 100000; ++i) {
          const double u = uniform(random), v = uniform(random);
          upward += sample(glm::dvec2(u, v)).z > 0 ? 1e-5 : 0;
        }
        SCOPED_TRACE(testing::Message() << "anisotropy " << anisotropy << ", NoV " << NoV << ", phi " << phi);
        tests::expectDensity(sample, pdf, upward, 5 * 0.5 / std::sqrt(1e5));
      }
}

// By even steps of the same visible normals' square, in which the integrand is continuous.
double albedoBySum(const StretchedLobe& lobe, const glm::dvec3& view) {
  constexpr int kSteps = 400;
  double sum = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const glm::dvec3 h = lobe.sampleHalf(view, {(i + 0.5) / kSteps, (j + 0.5) / kSteps});
      const glm::dvec3 light = 2 * glm::dot(view, h) * h - view;
      if (light.z > 0) sum += lobe.V(view, light) * light.z / lobe.pdfOverD(view);
    }
  return sum / (kSteps * kSteps);
}

TEST_F(StretchedLobeTest, AlbedoIsWithinAThousandth) {
  const auto white = [](double) { return glm::dvec3(1); };
  double worst = 0, squares = 0;
  int count = 0;
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith})
    for (const double roughness : {0.06, 0.2, 0.5, 0.8})
      for (const double strength : {0.2, 0.6, 1.0})
        for (const double NoV : {1e-4, 0.05, 0.3, 0.7, 1.0})
          for (const double phi : {0.0, 0.9, pi / 2}) {
            const double alpha = roughness * roughness;
            const StretchedLobe lobe{shading::f64::anisotropicAlpha(alpha, strength), alpha, term};
            const glm::dvec3 view = viewAlong(NoV, phi);
            const double error = integrateView(lobe, view, white).E - albedoBySum(lobe, view);
            worst = std::max(worst, std::abs(error));
            squares += error * error;
            ++count;
          }
  std::printf("albedo of one view: rms %.1e, max %.1e\n", std::sqrt(squares / count), worst);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(std::sqrt(squares / count), 2.5e-4);
}

// The lattice is of visible normals; the table of round lobes is made of another rule. What is read of it is the mean
// of F.
TEST_F(StretchedLobeTest, MeanFresnelOfARoundLobeIsTheTables) {
  double worst = 0;
  for (const double roughness : {0.05, 0.1, 0.2, 0.4, 0.7, 1.0})
    for (const double NoV : {0.02, 0.1, 0.4, 1.0}) {
      const double alpha = roughness * roughness;
      const auto own = integrateView({alpha, alpha}, viewAlong(NoV, 0.4),
                                     [](double VoH) { return glm::dvec3(std::pow(1 - VoH, 5)); });
      const AlbedoRow row = albedo().row(roughness);
      EXPECT_NEAR(own.E, row.at(NoV), 3e-3);
      worst = std::max(worst, std::abs(own.reflected.x / own.E - row.fresnelWeightAt(NoV)));
    }
  std::printf("mean of Fresnel's weight, round: %.1e off at worst\n", worst);
  EXPECT_LT(worst, 1e-3);
}

TEST_F(StretchedLobeTest, SunIsTheClosedFormForBothGeometryTerms) {
  const scenes::Light sun = sunFrom({0.3f, 0.8f, 0.4f});
  const glm::dvec3 L = -glm::dvec3(sun.direction);
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith})
    for (const float roughness : {0.1f, 0.5f, 0.9f})
      for (const float anisotropy : {0.2f, 0.8f})
        for (const double turn : {0.0, 0.5, 2.0}) {
          const SurfaceSample sample = brushed(0.6, roughness, 0.25f, anisotropy, turn);
          const DirectLight result = shadeDirect(sample, {sun}, tests::plainModel(term), nullptr);
          for (int c = 0; c < 3; ++c) {
            const double specular = sun.color[c] * textbook(sample, L, term) * schlickAt(sample, L, c);
            EXPECT_NEAR(result.sunSpecular[c], specular, 1e-5 * specular) << roughness << ", " << turn;
          }
        }
}

TEST_F(StretchedLobeTest, EnvironmentIsTheSumOverItsCells) {
  const scenes::Environment environment = tests::makeSunnyPanorama();
  for (const float roughness : {0.2f, 0.5f})
    for (const float anisotropy : {0.4f, 0.9f}) {
      const SurfaceSample sample = brushed(0.6, roughness, 1, anisotropy, 0.6);
      double sum = 0;
      for (int y = 0; y < tests::kPanoramaHeight / 2; ++y) // N = +Y: the upper half
        for (int x = 0; x < tests::kPanoramaWidth; ++x) {
          const double radiance = environment.radiance.at(x, y)[1];
          const int sub = radiance > 10 ? 8 : 2;
          for (int k = 0; k < sub * sub; ++k) {
            const int i = k % sub, j = k / sub;
            const glm::dvec3 L = tests::cellDirection(x + (i + 0.5) / sub - 0.5, y + (j + 0.5) / sub - 0.5);
            const double top = pi * (y + double(j) / sub) / tests::kPanoramaHeight;
            const double area = (std::cos(top) - std::cos(top + pi / sub / tests::kPanoramaHeight)) * 2 * pi / sub /
                                tests::kPanoramaWidth;
            sum += radiance * area * textbook(sample, L, GeometryTerm::heightCorrelated) * schlickAt(sample, L, 1);
          }
        }
      const IntegralOptions exact{.relativeError = 3e-4, .minSamples = 1024, .maxSamples = 1 << 17};
      const Lobes lobes(sample, tests::plainModel(), roughness, nullptr);
      const Integral sky = integrateEnvironment(sample, lobes, sunny(), glm::dvec3(0), exact);
      EXPECT_NEAR(sky.specular.y, sum, 5 * sky.standardError.y + 1e-3 * sum) << roughness << ", " << anisotropy;
      EXPECT_LT(sky.standardError.y, 2e-3 * sum);
    }
}

TEST_F(StretchedLobeTest, WithoutAnisotropyNothingChangesAndNothingJumps) {
  SurfaceSample plain = brushed(0.4, 0.5f, 0.5f, 0, 0.3), turned = plain;
  plain.tangent = glm::vec3(0);
  const Inputs inputs = inputsOf(&sunny(), {sunFrom({0.3f, 0.8f, 0.4f})});
  const ShadedSample a = shadeOne(plain, inputs), b = shadeOne(turned, inputs);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  turned.anisotropy = 0.01f;
  const IntegralOptions exact{.relativeError = 5e-4, .minSamples = 1024, .maxSamples = 1 << 16};
  const glm::dvec3 none = sumOfTerms(shadeOne(plain, inputs, exact)),
                   little = sumOfTerms(shadeOne(turned, inputs, exact));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(little[c], none[c], 4e-3 * none[c]);
}

// A quarter turn of everything about the normal changes nothing, and the tangent's sign is of no account.
TEST_F(StretchedLobeTest, LobeTurnsWithItsTangent) {
  SurfaceSample sample = brushed(0.6, 0.3f, 1, 0.8f, 0.4), back = sample;
  back.tangent = -back.tangent;
  const auto lightOf = [&](const SurfaceSample& s, const glm::vec3& towards) {
    return shadeDirect(s, {sunFrom(towards)}, Model{}, &albedo()).sunSpecular.y;
  };
  const glm::vec3 towards(0.3f, 0.8f, 0.4f);
  const double seen = lightOf(sample, towards);
  EXPECT_NEAR(lightOf(back, towards), seen, 3e-4 * seen); // the albedo's lattice has no mirror image
  const auto quarter = [](const glm::vec3& v) { return glm::vec3(-v.z, v.y, v.x); };
  SurfaceSample turned = sample;
  turned.view = quarter(sample.view);
  turned.tangent = quarter(sample.tangent);
  EXPECT_NEAR(lightOf(turned, quarter(towards)), seen, 3e-4 * seen);
  sample.tangent = quarter(sample.tangent);
  EXPECT_GT(std::abs(lightOf(sample, towards) / seen - 1), 0.1);
}

// A control variate and where samples go are made of it: it may be off, but not by much.
TEST_F(StretchedLobeTest, EstimateIsAboutTheLobe) {
  for (const GeometryTerm term : {GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith})
    for (const float anisotropy : {0.3f, 1.f})
      for (const double NoV : {0.05, 0.4, 1.0}) {
        const Lobes lobes(brushed(0.5, 0.4f, 0.5f, anisotropy, 0), tests::plainModel(term), 0.4, nullptr);
        const glm::dvec3 view = viewAlong(NoV, 0.6);
        const StretchedAxes axes = lobes.stretchedAxes({1, 0, 0}, {0, 1, 0});
        for (int i = 0; i < 100; ++i) {
          FourDirections four;
          std::array<glm::dvec3, 4> directions;
          for (int k = 0; k < 4; ++k) {
            directions[k] = viewAlong((i + 0.5) / 100, 2.4 * (4 * i + k));
            for (int c = 0; c < 3; ++c)
              (c == 0 ? four.x : c == 1 ? four.y : four.z)[k] = static_cast<float>(directions[k][c]);
          }
          const auto estimate = lobes.estimateSpecular(four, {0, 0, 1}, glm::vec3(view), {}, axes);
          for (int k = 0; k < 4; ++k) {
            const glm::dvec3 exact = lobes.evaluate(view, directions[k], {}).specular;
            for (int c = 0; c < 3; ++c)
              EXPECT_NEAR(estimate[static_cast<std::size_t>(c)][k], exact[c], 1e-2 * exact[c] + 1e-4)
                  << anisotropy << ", " << NoV << ", NoL " << directions[k].z;
          }
        }
      }
}

// A tangent that is no direction, and alphas at both ends.
TEST_F(StretchedLobeTest, NothingOfAnyAnisotropyIsNanOrNegative) {
  std::vector<SurfaceSample> samples;
  for (const float roughness : {0.f, 1e-3f, 0.02f, 0.5f, 1.f})
    for (const double NoV : {-1.0, 0.0, 1e-6, 0.5, 1.0})
      for (const float anisotropy : {1e-4f, 0.3f, 1.f})
        for (const glm::vec3& tangent : {glm::vec3(1, 0, 0), glm::vec3(0), glm::vec3(0, 1, 0)}) {
          SurfaceSample sample = tests::makePoint(NoV, roughness, 0.5f);
          sample.anisotropy = anisotropy;
          sample.tangent = tangent;
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

// What Kulla and Conty's lobe takes for E(NoL): the round lobe of the projected alphas' mean square.
TEST(StretchedLobe, LosesOnAverageAboutWhatItsRoundLobeLoses) {
  const auto meanLoss = [](double alphaT, double alphaB) {
    const StretchedLobe lobe{.alphaT = alphaT, .alphaB = alphaB, .term = GeometryTerm::heightCorrelated};
    double sum = 0;
    constexpr int kCosines = 16, kTurns = 6;
    for (int i = 0; i < kCosines; ++i)
      for (int k = 0; k < kTurns; ++k)
        sum +=
            integrateView(lobe, viewAlong(std::sqrt((i + 0.5) / kCosines), (k + 0.5) * pi / (2 * kTurns)), [](double) {
              return glm::dvec3(1);
            }).E;
    return 1 - sum / (kCosines * kTurns);
  };
  for (const auto& [alpha, strength] : {std::pair{1e-4, 0.8}, {0.04, 0.3}, {0.04, 1.0}, {0.16, 0.8}, {0.5, 0.5}}) {
    const double alphaT = shading::f64::anisotropicAlpha(alpha, strength),
                 round = shading::f64::projectedAlpha(alphaT, alpha, 0, 0), lost = meanLoss(alphaT, alpha);
    EXPECT_NEAR(meanLoss(round, round), lost, 0.06 * lost + 1e-3) << alpha << " " << strength;
  }
}

} // namespace
} // namespace parity::reference
