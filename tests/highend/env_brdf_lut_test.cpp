// The environment BRDF table against an independent quadrature over light directions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "highend/env_brdf_lut.h"
#include "shading/shading.h"

namespace parity::highend {
namespace {

namespace f64 = shading::f64;

struct AB {
  double a = 0, b = 0, average = 0; // average: of the table alone
};

// The textbook integral over the light's direction, integral D V F NoL dL, by the midpoint rule in half-vector angles
// t, phi with tan t = alpha tan(s): the weights keep D and the Jacobian 4 VoH explicitly, where the table's own
// quadrature cancels them.
AB integrateDirectly(
    GeometryTerm term, double NoV, double roughness, int steps,
    double (*weightOf)(double VoH) = [](double VoH) { return std::pow(1 - VoH, 5); }) {
  const double alpha = roughness * roughness, sinV = std::sqrt(1 - NoV * NoV), pi = std::numbers::pi;
  AB sum;
  for (int j = 0; j < steps / 2; ++j) {
    const double cosPhi = std::cos(pi * (j + 0.5) / (steps / 2));
    const double limit = 0.5 * (std::atan2(sinV * cosPhi, NoV) + pi / 2), sLimit = std::atan(std::tan(limit) / alpha);
    for (int i = 0; i < steps; ++i) {
      const double s = sLimit * (i + 0.5) / steps, t = std::atan(alpha * std::tan(s));
      const double dtds = alpha / (std::cos(s) * std::cos(s) * (1 + std::pow(alpha * std::tan(s), 2)));
      const double NoH = std::cos(t), VoH = sinV * std::sin(t) * cosPhi + NoV * NoH, NoL = 2 * VoH * NoH - NoV;
      if (NoL <= 0 || VoH <= 0) continue;
      const double V = term == GeometryTerm::heightCorrelated ? f64::V_SmithGGXCorrelated(alpha, NoV, NoL)
                                                              : f64::V_SchlickSmith(alpha, NoV, NoL);
      const double dL = 4 * VoH * std::sin(t) * dtds * (sLimit / steps) * 2 * (pi / (steps / 2));
      const double weight = f64::D_GGX(alpha, NoH) * V * NoL * dL, fresnel = weightOf(VoH);
      sum.a += weight * (1 - fresnel);
      sum.b += weight * fresnel;
    }
  }
  return sum;
}

// Bilinear, as the shader reads.
AB read(const base::Image& lut, double NoV, double roughness) {
  const auto at = [&](double coordinate, int size) { return coordinate * (size - 1); };
  const double x = at(NoV, lut.width), y = at(roughness, lut.height);
  const int x0 = std::min(static_cast<int>(x), lut.width - 2), y0 = std::min(static_cast<int>(y), lut.height - 2);
  AB result;
  for (int k = 0; k < 4; ++k) {
    const int i = k % 2, j = k / 2;
    const double weight = (i ? x - x0 : 1 - (x - x0)) * (j ? y - y0 : 1 - (y - y0));
    result.average += weight * lut.at(x0 + i, y0 + j)[2];
    result.a += weight * lut.at(x0 + i, y0 + j)[0];
    result.b += weight * lut.at(x0 + i, y0 + j)[1];
  }
  return result;
}

class EnvBrdfLut : public testing::TestWithParam<GeometryTerm> {};

TEST(EnvBrdfLutTruth, MeetsTheClosedFormAtNormalIncidenceAndRoughnessOne) {
  // Schlick-Smith, R = N = 1: the directional albedo is 1 - ln 2 (docs/shading.md 1a).
  const AB truth = integrateDirectly(GeometryTerm::schlickSmith, 1, 1, 512);
  EXPECT_NEAR(truth.a + truth.b, 1 - std::numbers::ln2, 2e-6);
}

TEST_P(EnvBrdfLut, ReadBilinearlyIsWithinTheTargetsOverTheCore) {
  const base::Image lut = makeEnvBrdfLut(GetParam());
  // docs/design.md 10c, on F0 A + B at F0 = 1 and 0.04, over NoV, roughness in [0.05, 1]; points off the texel centres.
  constexpr int kPoints = 48;
  double sum1 = 0, sum04 = 0, max1 = 0, max04 = 0;
  std::vector<AB> truths(kPoints * kPoints);
  const auto coordinate = [&](int i) { return 0.05 + 0.95 * (i + 0.37) / kPoints; };
  base::parallelFor(truths.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      truths[i] = integrateDirectly(GetParam(), coordinate(static_cast<int>(i) % kPoints),
                                    coordinate(static_cast<int>(i) / kPoints), 128);
  });
  for (int i = 0; i < kPoints * kPoints; ++i) {
    const AB value = read(lut, coordinate(i % kPoints), coordinate(i / kPoints)), truth = truths[i];
    const double e1 = std::abs(value.a + value.b - truth.a - truth.b),
                 e04 = std::abs(0.04 * (value.a - truth.a) + value.b - truth.b);
    sum1 += e1 * e1, sum04 += e04 * e04;
    max1 = std::max(max1, e1), max04 = std::max(max04, e04);
  }
  const double rms1 = std::sqrt(sum1 / truths.size()), rms04 = std::sqrt(sum04 / truths.size());
  RecordProperty("rms_F0_1", std::to_string(rms1));
  RecordProperty("max_F0_1", std::to_string(max1));
  EXPECT_LE(rms1, 2e-4);
  EXPECT_LE(rms04, 2e-4);
  EXPECT_LE(max1, 5e-3);
  EXPECT_LE(max04, 5e-3);
}

// Observed over NoV >= 1/256 and roughness >= 1/64, where bilinear reading is all the error (docs/shading.md 2d):
// rms 2.9e-4 and max 6.0e-3 (height-correlated), 3.6e-4 and 9.5e-3 (Schlick-Smith).
TEST_P(EnvBrdfLut, ReadBilinearlyOverTheFullDomainStaysBounded) {
  const base::Image lut = makeEnvBrdfLut(GetParam());
  constexpr int kPoints = 64;
  std::vector<double> errors(kPoints * kPoints);
  base::parallelFor(errors.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double u = (static_cast<double>(i % kPoints) + 0.37) / kPoints;
      const double v = (static_cast<double>(i / kPoints) + 0.37) / kPoints;
      const double NoV = 1 / 256. + 255 / 256. * u, roughness = 1 / 64. + 63 / 64. * v;
      const AB truth = integrateDirectly(GetParam(), NoV, roughness, 128), value = read(lut, NoV, roughness);
      errors[i] = std::abs(value.a + value.b - truth.a - truth.b);
    }
  });
  double squares = 0;
  for (const double e : errors) squares += e * e;
  const double rms = std::sqrt(squares / errors.size()), most = *std::max_element(errors.begin(), errors.end());
  std::printf("full domain, F0 = 1: rms %.2e, max %.2e\n", rms, most);
  EXPECT_LE(rms, 5e-4);
  EXPECT_LE(most, 0.012);
}

TEST_P(EnvBrdfLut, WeighsFresnelByTheCurveAskedFor) {
  struct Curve {
    FresnelCurve curve;
    double (*weight)(double);
  };
  // Karis 2013, eq. 5, and Fresnel's equations by Snell's law for an index of 1.5, written out.
  for (const Curve& c :
       {Curve{FresnelCurve::sphericalGaussian, [](double u) { return std::exp2((-5.55473 * u - 6.98316) * u); }},
        Curve{FresnelCurve::dielectric, [](double u) {
                const double t = std::sqrt(1 - (1 - u * u) / 2.25);
                const double s = (u - 1.5 * t) / (u + 1.5 * t), p = (1.5 * u - t) / (1.5 * u + t);
                return (0.5 * (s * s + p * p) - 0.04) / 0.96;
              }}}) {
    const base::Image lut = makeEnvBrdfLut(GetParam(), c.curve, 64);
    for (const int x : {10, 30, 60})
      for (const int y : {8, 32, 63}) {
        const AB truth = integrateDirectly(GetParam(), x / 63., y / 63., 512, c.weight);
        EXPECT_NEAR(lut.at(x, y)[0], truth.a, 2e-4) << x << ", " << y;
        EXPECT_NEAR(lut.at(x, y)[1], truth.b, 2e-4) << x << ", " << y;
      }
  }
}

// docs/shading.md 5: what a white sphere keeps in a furnace. Its figures are rounded.
TEST_P(EnvBrdfLut, HoldsTheAverageOfItsAlbedo) {
  const base::Image lut = makeEnvBrdfLut(GetParam());
  const bool correlated = GetParam() == GeometryTerm::heightCorrelated;
  for (const auto& [roughness, loss] : correlated ? std::map<double, double>{{0.4, 5.9}, {0.8, 39.7}, {1.0, 59.1}}
                                                  : std::map<double, double>{{0.4, 13.0}, {0.8, 45.4}, {1.0, 62.3}})
    EXPECT_NEAR(read(lut, 0.5, roughness).average, 1 - loss / 100, 2e-3) << roughness;
}

TEST_P(EnvBrdfLut, IsBitIdenticalForAnyNumberOfThreads) {
  const base::Image all = makeEnvBrdfLut(GetParam(), FresnelCurve::schlick, 32);
  const base::ThreadLimit one(1);
  EXPECT_EQ(makeEnvBrdfLut(GetParam(), FresnelCurve::schlick, 32), all);
}

TEST_P(EnvBrdfLut, HoldsShares) {
  const base::Image lut = makeEnvBrdfLut(GetParam(), FresnelCurve::schlick, 64);
  for (std::size_t i = 0; i < lut.pixelCount(); ++i) {
    const float* texel = lut.pixels.data() + 4 * i;
    ASSERT_GE(texel[0], 0);
    ASSERT_GE(texel[1], 0);
    ASSERT_LE(texel[0] + texel[1], 1.0001f);
    ASSERT_TRUE(texel[2] > 0.3f && texel[2] <= 1.0001f);
  }
}

INSTANTIATE_TEST_SUITE_P(BothTerms, EnvBrdfLut,
                         testing::Values(GeometryTerm::heightCorrelated, GeometryTerm::schlickSmith),
                         [](const auto& which) {
                           return which.param == GeometryTerm::heightCorrelated ? "heightCorrelated" : "schlickSmith";
                         });

} // namespace
} // namespace parity::highend
