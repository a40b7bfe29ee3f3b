// The mobile path's direct specular: reflectance against the exact model as published, the clamp, and the printed
// forms.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
using std::numbers::pi;
constexpr std::array kViews = {0.1, 0.25, 0.5, 0.75, 1.0};

double environment(double roughness, double NoV) { return f64::EnvBRDFApprox({1, 1, 1}, roughness, NoV).x; }

double truth(double roughness, double NoV) {
  const EnvBrdf e = integrateEnvBrdf(Geometry::heightCorrelated, roughness, NoV);
  return e.A + e.B;
}

// Share of light from everywhere that D_Approx times EnvBRDFApprox times NoL sends to the view, F0 = 1; 1/pi is in the
// light's colour.
double reflectanceOfDApprox(double roughness, double NoV) {
  const double c = (0.5 / std::pow(roughness, 4) + 0.275) / std::numbers::ln2;
  return environment(roughness, NoV) * integrateAroundReflection(c, NoV, 12, [&](double NoL, double RoL) {
           return f64::D_Approx(roughness, RoL) * NoL / pi;
         });
}

// The same for CalcSpecular; `distribution` stands for GGX_Mobile within it.
template <typename D> double reflectanceOfCalcSpecular(double roughness, double NoV, D distributionTimesPi) {
  return environment(roughness, NoV) * integrateLobe(roughness * roughness, NoV, 12, [&](const Cosines& cosines) {
           return (roughness * 0.25 + 0.25) * distributionTimesPi(cosines.NoH) * cosines.NoL / pi;
         });
}

// A figure printed with this many decimals.
void expectPrinted(double actual, double printed, int decimals) {
  EXPECT_NEAR(actual, printed, 0.55 * std::pow(10, -decimals));
}

// docs/shading.md 3.
TEST(DApprox, ReflectsAgainstTheTruthAsPublished) {
  const std::array<std::pair<double, std::array<double, 5>>, 3> rows = {
      {{0.1, {.38, .95, 1.89, 2.84, 3.78}}, {0.5, {.57, .90, 1.48, 2.08, 2.69}}, {1, {.31, .42, .63, .87, 1.15}}}};
  for (const auto& [R, printed] : rows)
    for (std::size_t i = 0; i < kViews.size(); ++i)
      expectPrinted(reflectanceOfDApprox(R, kViews[i]) / truth(R, kViews[i]), printed[i], 2);
}

// docs/shading.md 3a: "its smooth-lobe ratio is about 4N; exitance reaches 3.89", over roughness >= 0.05.
TEST(DApprox, LacksTheQuarterOfTheMicrofacetDenominator) {
  for (const double N : kViews) // 1 - 0.55 R is EnvBRDFApprox at F0 = 1
    EXPECT_NEAR(reflectanceOfDApprox(0.05, N) / truth(0.05, N), 4 * N * (1 - 0.55 * 0.05), 0.01 * N);
  double most = 0;
  for (int i = 5; i <= 100; ++i)
    for (const double N : {0.8, 0.9, 1.0}) most = std::max(most, reflectanceOfDApprox(i / 100.0, N));
  expectPrinted(most, 3.89, 2);
}

// The steps of the article: Blinn's exponent 2/alpha^2 - 2 seen from r is a quarter of it, and the Gaussian stands for
// x^n as e^((n + 0.775)(x - 1)), so c ln 2 = n + 0.775 with n = 1/(2 alpha^2) - 1/2.
TEST(DApprox, IsTheArticlesSphericalGaussian) {
  for (const double R : {0.2, 0.5, 1.0})
    for (const double RoL : {0.5, 0.9, 1.0}) {
      const double a2 = std::pow(R, 4), n = 0.5 / a2 - 0.5;
      const double expected = std::exp((n + 0.775) * (RoL - 1)) / a2;
      EXPECT_NEAR(f64::D_Approx(R, RoL) / expected, 1, 1e-6); // the article prints its constants with 8 digits
    }
}

// Below roughness sqrt(.008) = .0894 the floor, beyond it the article's Gaussian; the exponentials written out here.
TEST(PhongApprox, IsTheArticlesGaussianWithAFloorUnderItsWidth) {
  for (const double R : {0.0, 0.05, 0.089, 0.0895, 0.2, 0.5, 1.0})
    for (const double RoL : {0.0, 0.5, 0.99, 0.9999, 1.0}) {
      const double a = std::max(R * R, 0.008), n = 0.5 / (a * a) - 0.5;
      const double expected = std::exp((n + 0.775) * (RoL - 1)) / (a * a);
      EXPECT_NEAR(f64::PhongApprox(R, RoL), expected, 2e-4 * expected) << R << " " << RoL; // constants of 8 digits
    }
  EXPECT_EQ(f64::PhongApprox(0.5, 0.9), f64::D_Approx(0.5, 0.9));
}

TEST(PhongApprox, HasItsPeakAtOneAlsoWhereACosineRoundsToAbove) {
  for (const double R : {0.0, 0.1, 0.5})
    for (const double above : {1 + 1e-7, 1.001, 1.1}) {
      EXPECT_EQ(f64::PhongApprox(R, above), f64::PhongApprox(R, 1));
      EXPECT_EQ(shading::f32::PhongApprox(float(R), float(above)), shading::f32::PhongApprox(float(R), 1));
    }
}

// What the floor is there for: in half 1 / a^2 stays finite, and is no quotient of a denormal.
TEST(PhongApprox, IsFiniteInHalfAtEveryRoughness) {
  using shading::Half;
  EXPECT_GE(float(Half(0.008) * Half(0.008)), 0x1p-14);
  for (std::uint16_t bits = 0; bits <= Half(1).bits(); ++bits)
    for (const double RoL : {0.0, 0.5, 1 - 0x1p-11, 1.0, 1 + 0x1p-10}) {
      const float D = float(shading::f16::PhongApprox(Half::fromBits(bits), Half(RoL)));
      ASSERT_TRUE(D >= 0 && D <= 15640) << float(Half::fromBits(bits)) << " " << RoL << ": " << D;
    }
}

TEST(GgxMobile, IsPiTimesGgxBelowTheClamp) {
  for (const double R : {0.2, 0.5, 1.0})
    for (const double NoH : {0.0, 0.5, 0.9, 1.0}) {
      const double unclamped = pi * distribution(R * R, NoH);
      EXPECT_NEAR(f64::GGX_Mobile(R, NoH) / unclamped, 1, 1e-9);
    }
}

// 1/alpha^2 > 2048 where roughness < 2048^(-1/4) = 0.1487.
TEST(GgxMobile, IsClampedAt2048FromRoughness0149Down) {
  EXPECT_LT(f64::GGX_Mobile(0.149, 1), 2048);
  EXPECT_EQ(f64::GGX_Mobile(0.1486, 1), 2048);
  EXPECT_EQ(f64::GGX_Mobile(0.015625, 1), 2048);
  EXPECT_EQ(shading::f32::GGX_Mobile(0.015625f, 1), 2048);
  EXPECT_EQ(float(shading::f16::GGX_Mobile(shading::Half(0.015625), 1)), 2048);
}

// docs/shading.md 3b: "leaves 70 % of the energy at R=.1, 21 % at R=.05": of the projected area that D NoH integrates
// to.
TEST(GgxMobile, ClampLeavesTheShareOfEnergyThatIsPublished) {
  for (const auto& [R, percent] : {std::pair{0.1, 70.0}, {0.05, 21.0}, {0.2, 100.0}}) {
    const double kept = integrateLobe(R * R, 1, 20, [&](const Cosines& cosines) {
      return f64::GGX_Mobile(R, cosines.NoH) / pi * cosines.NoH / (4 * cosines.VoH);
    });
    EXPECT_NEAR(100 * kept, percent, 0.5);
  }
}

// docs/shading.md 3b. Its row R = .1 is before the clamp; with it, .70 of that is left (.72 at N = .1, where part of
// the lobe is below the horizon).
TEST(CalcSpecular, ReflectsAgainstTheTruthAsPublished) {
  const std::array<std::pair<double, std::array<double, 5>>, 2> rows = {
      {{0.5, {.11, .18, .35, .58, .91}}, {1, {.30, .38, .50, .62, .73}}}};
  for (const auto& [R, printed] : rows)
    for (std::size_t i = 0; i < kViews.size(); ++i) {
      const double roughness = R;
      const double actual =
          environment(R, kViews[i]) * integrateLobe(R * R, kViews[i], 12, [&](const Cosines& cosines) {
            return f64::CalcSpecular(roughness, cosines.NoH) * cosines.NoL / pi;
          });
      expectPrinted(actual / truth(R, kViews[i]), printed[i], 2);
    }
  const std::array<double, 5> smooth = {.011, .066, .26, .58, 1.04};
  const std::array<int, 5> decimals = {3, 3, 2, 2, 2};
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    const double unclamped =
        reflectanceOfCalcSpecular(0.1, kViews[i], [](double NoH) { return pi * distribution(0.01, NoH); });
    expectPrinted(unclamped / truth(0.1, kViews[i]), smooth[i], decimals[i]);
    const double clamped =
        reflectanceOfCalcSpecular(0.1, kViews[i], [](double NoH) { return f64::GGX_Mobile(0.1, NoH); });
    EXPECT_NEAR(clamped / unclamped, 0.70, 0.02);
  }
}

TEST(CalcSpecular, ScalesTheDistributionByAQuarterToAHalf) {
  EXPECT_DOUBLE_EQ(f64::CalcSpecular(1, 0.5), 0.5 * f64::GGX_Mobile(1, 0.5));
  EXPECT_DOUBLE_EQ(f64::CalcSpecular(0.4, 0.9), 0.35 * f64::GGX_Mobile(0.4, 0.9));
}

} // namespace
} // namespace parity::tests
