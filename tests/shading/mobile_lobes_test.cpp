// Clear coat and sheen of the mobile path: against the formulas written out in double, and finite over the whole domain
// in every precision.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f16 = shading::f16;
using shading::Half;
using std::numbers::pi;

TEST(MobileCoat, FresnelIsSchlicksAtTheCoatsIndex) {
  for (const double cosine : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const double expected = 0.04 + 0.96 * std::pow(1 - cosine, 5);
    EXPECT_NEAR(f64::coatFresnel(cosine), expected, 1e-12);
    EXPECT_NEAR(static_cast<float>(f16::coatFresnel(Half(static_cast<float>(cosine)))), expected, 2e-3);
  }
}

f64::MobileMaterial makePaint(double metallic, double roughness) {
  f64::MobileMaterial m;
  m.BaseColor = {0.8, 0.4, 0.1};
  m.Metallic = metallic;
  m.DielectricSpecular = {0.04, 0.04, 0.04};
  m.F90 = 1;
  m.Roughness = roughness;
  return m;
}

TEST(MobileCoat, UE4sCoatDimsADielectricByWhatItReflects) {
  const f64::MobileMaterial m = makePaint(0, 1);
  for (const double NoV : {0.1, 0.5, 1.0}) {
    const f64::MobileMaterial none = f64::underCoatUE4(m, 0, NoV), whole = f64::underCoatUE4(m, 1, NoV);
    const double kept = 1 - (0.04 + 0.96 * std::pow(1 - NoV, 5));
    EXPECT_NEAR(none.BaseColor.x, 0.8, 1e-12);
    EXPECT_NEAR(whole.BaseColor.x, 0.8 * kept, 1e-12);
    EXPECT_NEAR(whole.BaseColor.z, 0.1 * kept, 1e-12);
    EXPECT_NEAR(whole.DielectricSpecular.x, 0.04, 1e-12) << "a rough base has no refraction";
  }
}

// RefractionScale and Absorption as the engine's source has them.
TEST(MobileCoat, UE4sCoatDarkensAMetalByAbsorption) {
  const double roughness = 0.3;
  const f64::MobileMaterial m = makePaint(1, roughness);
  for (const double NoV : {0.3, 0.7, 1.0}) {
    const double refraction = ((NoV * 0.5 + 0.5) * NoV - 1) * std::clamp(1.25 - 1.25 * roughness, 0.0, 1.0) + 1;
    const f64::MobileMaterial under = f64::underCoatUE4(m, 1, NoV);
    for (const auto& [color, result] :
         {std::pair{0.8, under.BaseColor.x}, {0.4, under.BaseColor.y}, {0.1, under.BaseColor.z}}) {
      const double a = color / 0.9, mixed = a + (a * a - a) * -0.78;
      const double absorption = a * ((NoV - 1) * 0.85 * (1 - mixed) + 1);
      EXPECT_NEAR(result, 0.9 * absorption * refraction, 1e-7);
    }
    EXPECT_NEAR(under.DielectricSpecular.y, 0.04 * refraction, 1e-12);
  }
}

TEST(MobileCoat, UE4sLightIsFresnelVisibilityAndGgx) {
  for (const double roughness : {0.2, 0.5, 1.0})
    for (const double NoV : {0.2, 0.8})
      for (const double NoL : {0.1, 0.6}) {
        const double a = roughness * roughness, F = 0.3, NoH = 0.95;
        const double visibility = 0.5 / (NoL * (NoV * (1 - a) + a) + NoV * (NoL * (1 - a) + a));
        const double expected = NoL * F * visibility * std::min(pi * distribution(a, NoH), 2048.0);
        EXPECT_NEAR(f64::coatLightUE4(F, roughness, NoV, NoL, NoH), expected, 1e-9 * expected);
      }
}

// What refit takes for the coat's albedo: rms <= .01.
TEST(MobileCoat, RefitsAlbedoIsNearTheIntegral) {
  double squares = 0, worst = 0;
  int count = 0;
  for (double roughness = 0.05; roughness <= 1.001; roughness += 0.05)
    for (double NoV = 0.03; NoV <= 1; NoV += 0.0485) {
      const EnvBrdf e = integrateEnvBrdf(Geometry::heightCorrelated, roughness, NoV, 8);
      const double error = f64::refitNonmetalLobe(roughness, NoV).single.x - (0.04 * e.A + e.B);
      squares += error * error, worst = std::max(worst, std::abs(error)), ++count;
    }
  std::printf("refit's coat albedo: rms %.4f, worst %.4f\n", std::sqrt(squares / count), worst);
  EXPECT_LE(std::sqrt(squares / count), 0.01);
}

TEST(MobileSheen, LightIsPiTimesTheLobe) {
  for (const double roughness : {0.1, 0.5, 1.0}) {
    const double alpha = f64::sheenAlpha(roughness), NoV = 0.4, NoL = 0.3, NoH = 0.5;
    const double D = (2 + 1 / alpha) * std::pow(1 - NoH * NoH, 0.5 / alpha) / (2 * pi),
                 V = 0.25 / (NoL + NoV - NoL * NoV);
    EXPECT_NEAR(f64::sheenLightFit(alpha, NoV, NoL, NoH), pi * D * V * NoL, 1e-9);
  }
}

TEST(MobileSheen, LeavesWhatItDoesNotReflect) {
  EXPECT_NEAR(f64::belowSheen({0.2, 0.9, 0.4}, 0.5), 1 - 0.9 * 0.5, 1e-12);
  EXPECT_EQ(f64::belowSheen({0, 0, 0}, 0.5), 1);
  EXPECT_EQ(f64::belowSheen({1, 1, 1}, 1.1), 0);
}

// Every function at every corner and in between, in half: nothing that is no number, nothing negative.
TEST(MobileLobes, AreFiniteInHalfOverTheirDomain) {
  const auto half = [](double x) { return Half(static_cast<float>(x)); };
  const std::vector<double> shares = {0, 6e-8, 1e-4, 1e-3, 0.05, 0.3, 0.5, 0.9, 0.999, 1};
  const auto expectSound = [](Half value) {
    const float x = static_cast<float>(value);
    ASSERT_TRUE(std::isfinite(x) && x >= 0) << x;
  };
  for (const double r : shares)
    for (const double v : shares) {
      expectSound(f16::coatFresnel(half(v)));
      expectSound(f16::sheenAlbedoFit(half(r), half(v)));
      for (const double l : shares) {
        for (const double h : shares) {
          expectSound(f16::coatLightUE4(half(h), half(std::max(r, 0.015625)), half(v), half(l), 1.f));
          expectSound(f16::coatLightUE4(half(1), half(std::max(r, 0.015625)), half(v), half(l), static_cast<float>(h)));
          expectSound(f16::sheenLightFit(f16::sheenAlpha(half(r)), half(v), half(l), half(h)));
        }
        f16::MobileMaterial m;
        m.BaseColor = {half(1), half(l), half(0)};
        m.Metallic = half(l);
        m.DielectricSpecular = {half(0.08), half(0.04), half(0)};
        m.Roughness = half(r);
        const f16::MobileMaterial under = f16::underCoatUE4(m, half(1), half(v));
        for (const Half value : {under.BaseColor.x, under.BaseColor.y, under.BaseColor.z, under.DielectricSpecular.x})
          expectSound(value);
      }
    }
}

} // namespace
} // namespace parity::tests
