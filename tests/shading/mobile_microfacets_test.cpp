// Anisotropy and thin films of the mobile path: against the high-end path's formulas, and finite over the whole domain
// in every precision.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f16 = shading::f16;
using shading::Half;
using std::numbers::pi;

TEST(MobileAnisotropy, RoundLobeHasTheGeometricMeanOfBothAlphas) {
  for (const double roughness : {0.1, 0.5, 1.0})
    for (const double strength : {0.0, 0.6, 1.0}) {
      const double alpha = roughness * roughness, along = f64::anisotropicAlpha(alpha, strength);
      const f64::MobileAnisotropy a = f64::mobileAnisotropy(roughness, strength);
      EXPECT_NEAR(std::pow(a.Roughness, 4), alpha * along, 1e-12);
      EXPECT_NEAR(std::pow(a.readRoughness, 4), std::max(alpha * along, along * along / 16), 1e-12);
      EXPECT_NEAR(a.squeeze, alpha / along, 1e-12);
      EXPECT_NEAR(a.share, (along - alpha) / (along + alpha), 1e-12);
    }
}

TEST(MobileAnisotropy, SqueezedPeakIsTheElongatedDistribution) {
  const double roughness = 0.4, strength = 0.7, alpha = roughness * roughness;
  const double along = f64::anisotropicAlpha(alpha, strength);
  const f64::MobileAnisotropy a = f64::mobileAnisotropy(roughness, strength);
  const f64::RefitLobe lobe = f64::refitLobe({1, 1, 1}, 1, a.Roughness, 0.8);
  for (const double theta : {0.0, 0.2, 0.7, 1.3})
    for (const double phi : {0.0, 0.5, 1.5}) {
      const double x = std::sin(theta) * std::cos(phi), y = std::sin(theta) * std::sin(phi), z = std::cos(theta);
      const double D = f64::D_GGXAnisotropic(along, alpha, x, y, z);
      const double V = f64::V_SmithGGXCorrelated(lobe.alpha, 0.8, 0.6);
      EXPECT_NEAR(f64::squeezedRefitPeak(lobe, 0.6, z, f64::squeezedSin2(x, y, a.squeeze)), pi * D * V * 0.6,
                  1e-6 * pi * D);
      EXPECT_NEAR(f64::squeezedCalcSpecular(a.Roughness, z, f64::squeezedSin2(x, y, a.squeeze)),
                  std::min(pi * D, 2048.0) * (0.25 + 0.25 * a.Roughness), 1e-6 * pi * D);
    }
}

TEST(MobileAnisotropy, WithoutStrengthItIsTheRoundLobe) {
  const f64::MobileAnisotropy a = f64::mobileAnisotropy(0.3, 0);
  EXPECT_NEAR(a.Roughness, 0.3, 1e-12);
  EXPECT_EQ(a.share, 0);
  const f64::RefitLobe lobe = f64::refitLobe({0.9, 0.5, 0.2}, 1, 0.3, 0.7);
  const double NoH = 0.95;
  const f64::real3 round = f64::refitLight(lobe, 0.5, {NoH, 0.8}),
                   squeezed = f64::squeezedRefitLight(lobe, 0.5, {NoH, 0.8},
                                                      f64::squeezedSin2(0.1, std::sqrt(1 - NoH * NoH - 0.01), 1));
  EXPECT_NEAR(squeezed.x, round.x, 1e-9);
  EXPECT_NEAR(squeezed.z, round.z, 1e-9);
}

TEST(MobileAnisotropy, BentNormalLiesBetweenTheNormalAndTheFibres) {
  const f64::real32x3 N{0, 0, 1}, B{0, 1, 0}, V{0.6, 0.64, 0.48};
  const f64::real32x3 none = f64::bentNormal(N, B, V, 0), whole = f64::bentNormal(N, B, V, 1);
  EXPECT_NEAR(none.z, 1, 1e-12);
  EXPECT_NEAR(whole.y, 0, 1e-12) << "at right angles to the bitangent";
  EXPECT_NEAR(whole.x, 0.6 / std::hypot(0.6, 0.48), 1e-12);
  EXPECT_NEAR(f64::bentNormal(N, B, B, 1).z, 1, 1e-12) << "seen along the bitangent";
}

// Root mean square of the error of three channels, over film and base.
double errorOfTint(bool hasFilm) {
  double sum = 0;
  int count = 0;
  for (const double ior : {1.2, 1.33, 1.5, 1.75, 2.0})
    for (double thickness = 100; thickness <= 800; thickness += 35)
      for (const double F0 : {0.02, 0.04, 0.08, 0.2, 0.4, 0.6, 0.8, 0.95})
        for (const double cosine : {0.2, 0.4, 0.6, 0.8, 1.0}) {
          const f64::real3 exact = f64::thinFilmFresnel(ior, thickness, {F0, F0, F0}, cosine);
          const f64::real3 tint =
              hasFilm ? f64::filmTint(ior, thickness, {F0, F0, F0}, cosine) : f64::real3{F0, F0, F0};
          const double weight = std::pow(1 - cosine, 5);
          for (const auto& [a, b] : {std::pair{exact.x, tint.x}, {exact.y, tint.y}, {exact.z, tint.z}}) {
            sum += std::pow(a - (b + (1 - b) * weight), 2);
            ++count;
          }
        }
  return std::sqrt(sum / count);
}

TEST(MobileFilm, TintIsNearerToTheFilmThanTheBase) {
  std::printf("rms of the tint %.4f, without it %.4f\n", errorOfTint(true), errorOfTint(false));
  EXPECT_LT(errorOfTint(true), 0.085);
  EXPECT_GT(errorOfTint(false), 1.6 * errorOfTint(true));
}

// Thick films are grey: no channel goes on oscillating.
TEST(MobileFilm, ThickFilmsHaveNoFringes) {
  for (double thickness = 8000; thickness < 8600; thickness += 50) {
    const f64::real3 thick = f64::filmTint(1.8, thickness, {0.4, 0.4, 0.4}, 1),
                     more = f64::filmTint(1.8, 2 * thickness, {0.4, 0.4, 0.4}, 1);
    EXPECT_NEAR(thick.x, more.x, 1e-3);
    EXPECT_NEAR(thick.z, more.z, 1e-3);
  }
}

// At normal incidence of one wavelength and a film without thickness: the bare base.
TEST(MobileFilm, ReflectanceIsAirysSum) {
  EXPECT_NEAR(f64::filmReflectance(1.4, 0.3, 0, 0), 0.3, 1e-12);
  EXPECT_NEAR(f64::filmReflectance(1.7, 0.04, 0, 0), 0.04, 1e-12);
  EXPECT_NEAR(f64::filmReflectance(1.7, 1, 0.3, 0), 1, 1e-12);
  // A quarter wave of sqrt(nb) is an antireflective coating.
  const double nb = 2.25, F0 = std::pow((nb - 1) / (nb + 1), 2);
  EXPECT_NEAR(f64::filmReflectance(1.5, F0, 0.5, 0), 0, 1e-12);
}

TEST(MobileMicrofacets, AreFiniteInHalfOverTheirDomain) {
  const auto isFine = [](const f16::real3& c, float most) {
    for (const Half x : {c.x, c.y, c.z}) {
      const auto value = static_cast<float>(x);
      if (!(value >= 0 && value <= most)) return false;
    }
    return true;
  };
  for (float roughness : {0.f, 0.015625f, 0.1f, 0.5f, 1.f})
    for (float strength : {0.f, 0.5f, 1.f})
      for (float NoV : {0.f, 1e-4f, 0.3f, 1.f})
        for (float NoL : {0.f, 1e-4f, 0.3f, 1.f})
          for (float theta : {0.f, 1e-3f, 0.7f, 1.5707f})
            for (float phi : {0.f, 0.8f, 1.5707f}) {
              const f16::MobileAnisotropy a = f16::mobileAnisotropy(Half(roughness), Half(strength));
              const float x = std::sin(theta) * std::cos(phi), y = std::sin(theta) * std::sin(phi);
              const float sin2 = f16::squeezedSin2(x, y, a.squeeze);
              const f16::RefitLobe lobe =
                  f16::refitLobe({Half(1.f), Half(0.5f), Half(0.f)}, Half(1.f), a.Roughness, Half(NoV));
              EXPECT_TRUE(isFine(f16::squeezedRefitLight(lobe, Half(NoL), {std::cos(theta), 0.5f}, sin2), 65504));
              const auto lit = static_cast<float>(f16::squeezedCalcSpecular(a.Roughness, std::cos(theta), sin2));
              EXPECT_TRUE(lit >= 0 && lit <= 1024) << lit;
            }
  for (float ior : {1.f, 1.3f, 3.f})
    for (float thickness : {0.f, 30.f, 400.f, 60000.f})
      for (float F0 : {0.f, 0.04f, 1.f})
        for (float NoV : {0.f, 0.5f, 1.f})
          EXPECT_TRUE(isFine(f16::filmTint(ior, thickness, {Half(F0), Half(F0), Half(F0)}, Half(NoV)), 1));
}

} // namespace
} // namespace parity::tests
