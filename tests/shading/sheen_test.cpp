// The sheen of cloth: distribution, shadowing and albedo against quadrature, closed forms and the published numbers.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shading/flushed_half.h"
#include "shading/quadrature.h"
#include "shading/shading.h"
#include "shading/sheen_formula.h"

namespace parity::shading {
// sheen.glsl alone, once more.
#define FN inline
#define CONSTANT inline constexpr
#define PRECISE
#define R(x) real(x)
namespace flushedSheen {
using real = tests::FlushedHalf;
inline constexpr real kSmallest(0x1p-14), kLargest(65504.0), kInvPi(0.318309886183790672);
FN real saturate(real x) { return min(max(x, R(0.0)), R(1.0)); }
#define PARITY_SHADING_REAL
#undef PARITY_SHADING_SHEEN
#include "shading/sheen.glsl"
#undef PARITY_SHADING_REAL
} // namespace flushedSheen
#undef FN
#undef CONSTANT
#undef PRECISE
#undef R
} // namespace parity::shading

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f16 = shading::f16;
using shading::Half;
using std::numbers::pi;

// The projected area of the microfacets is that of the surface: the integral of D NoH is 1. Smooth sheens are narrow
// about NoH = 0: panels of the angle widen from there.
TEST(Sheen, DistributionIsNormalised) {
  const PanelRule rule({0, 0.01, 0.03, 0.1, 0.2, 0.4, 0.8, pi / 2}, 24); // from the tangent plane
  for (const double roughness : {0.0, 0.07, 0.1, 0.3, 0.5, 0.8, 1.0}) {
    const double alpha = f64::sheenAlpha(roughness);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double NoH = std::sin(rule.nodes[i]), sine = std::cos(rule.nodes[i]);
      sum += rule.weights[i] * 2 * pi * f64::D_Charlie(alpha, NoH) * NoH * sine;
    }
    EXPECT_NEAR(sum, 1, 1e-8) << roughness;
  }
}

// alpha = 1: 3 sin / (2 pi); alpha = 1/2: 4 sin^2 / (2 pi).
TEST(Sheen, DistributionHasItsClosedForms) {
  for (const double NoH : {0.0, 0.3, 0.8, 1.0}) {
    const double sine = std::sqrt(1 - NoH * NoH);
    EXPECT_NEAR(f64::D_Charlie(1, NoH), 3 * sine / (2 * pi), 1e-12);
    EXPECT_NEAR(f64::D_Charlie(0.5, NoH), 4 * sine * sine / (2 * pi), 1e-12);
  }
}

TEST(Sheen, AlphaIsTheSquareWithAFloor) {
  EXPECT_DOUBLE_EQ(f64::sheenAlpha(0.5), 0.25);
  EXPECT_DOUBLE_EQ(f64::sheenAlpha(1), 1);
  EXPECT_DOUBLE_EQ(f64::sheenAlpha(0), 0.0049);
  EXPECT_DOUBLE_EQ(f64::sheenAlpha(0.07), 0.0049);
}

// Estevez and Kulla's two columns of coefficients, worked by hand at x = 1/2 and 1/4.
TEST(Sheen, ShadowingHasThePublishedCoefficients) {
  const auto L = [](double a, double b, double c, double d, double e, double x) {
    return a / (1 + b * std::pow(x, c)) + d * x + e;
  };
  for (const double x : {0.02, 0.25, 0.5}) {
    EXPECT_NEAR(f64::charlieExponent(0, x), L(25.3245, 3.32435, 0.16801, -1.27393, -4.85967, x), 1e-12);
    EXPECT_NEAR(f64::charlieExponent(1, x), L(21.5473, 3.82987, 0.19823, -1.97760, -4.32054, x), 1e-12);
    EXPECT_NEAR(f64::charlieExponent(0.5, x), // a quarter of the way from alpha = 1
                L(22.491600, 3.703490, 0.190675, -1.8016825, -4.4553225, x), 1e-9);
    EXPECT_NEAR(f64::charlieLambda(1, x) / std::exp(L(21.5473, 3.82987, 0.19823, -1.97760, -4.32054, x)), 1, 1e-8);
  }
  for (const double alpha : {0.0049, 0.2, 1.0}) {
    EXPECT_NEAR(f64::charlieLambda(alpha, 0.5 - 1e-9), f64::charlieLambda(alpha, 0.5), 1e-7) << "no step at 1/2";
    EXPECT_LT(f64::charlieLambda(alpha, 1), 1e-6) << "nothing is hidden from above";
  }
}

// What of a direction's facets is seen, G1 = cos / (integral of D max(0, v.h)), by Smith's integral over what the
// published Lambda gives, 1 / (1 + Lambda).
double shadowingError(double roughness, double cosine, bool relative) {
  const double alpha = f64::sheenAlpha(roughness), sine = std::sqrt(1 - cosine * cosine);
  constexpr int kSteps = 600;
  double area = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double root = (i + 0.5) / kSteps, NoH = root * root, sinH = std::sqrt(1 - NoH * NoH);
    for (int j = 0; j < kSteps; ++j) {
      const double VoH = cosine * NoH + sine * sinH * std::cos((j + 0.5) / kSteps * pi);
      area += 2 * root / kSteps * 2 * pi / kSteps * f64::D_Charlie(alpha, NoH) * std::max(VoH, 0.0);
    }
  }
  const double seen = cosine / area, published = 1 / (1 + f64::charlieLambda(alpha, cosine));
  return relative ? published / seen : published - seen;
}

// A fit of it from roughness 0.3 on, and twice as much below: so the albedo of a smooth sheen exceeds 1.
TEST(Sheen, ShadowingIsSmithsIntegralFromRoughness03) {
  double worst = 0;
  for (const double cosine : {0.05, 0.2, 0.5, 0.8}) {
    for (const double roughness : {0.3, 0.6, 1.0})
      worst = std::max(worst, std::abs(shadowingError(roughness, cosine, false)));
    const double tooMuch = shadowingError(0.1, cosine, true);
    EXPECT_TRUE(tooMuch > 1.9 && tooMuch < 2.6) << tooMuch;
    EXPECT_NEAR(shadowingError(1, cosine, false), 0, 6e-3);
  }
  std::printf("G1 of the published Lambda from roughness 0.3 on: %.3f off at worst\n", worst);
  EXPECT_LT(worst, 0.04);
}

TEST(Sheen, VisibilityIsReciprocalAndFinite) {
  for (const double alpha : {0.0049, 0.1, 1.0})
    for (const double a : {1e-3, 0.1, 0.7, 1.0})
      for (const double b : {2e-3, 0.4, 1.0}) {
        EXPECT_NEAR(f64::V_Charlie(alpha, a, b) / f64::V_Charlie(alpha, b, a), 1, 1e-12);
        EXPECT_NEAR(f64::V_Charlie(alpha, a, b) *
                        ((1 + f64::charlieLambda(alpha, a) + f64::charlieLambda(alpha, b)) * 4 * a * b),
                    1, 1e-12);
        EXPECT_EQ(f64::V_Neubelt(a, b), f64::V_Neubelt(b, a));
      }
  EXPECT_NEAR(f64::V_Neubelt(1, 0.5), 0.25, 1e-15); // 1 / (4 (1 + .5 - .5))
  EXPECT_NEAR(f64::V_Neubelt(0.5, 0.5), 1 / 3.0, 1e-15);
  EXPECT_TRUE(std::isfinite(f64::V_Charlie(0.25, 0, 0)) && std::isfinite(f64::V_Neubelt(0, 0)));
  EXPECT_EQ(f64::V_Charlie(0.25, 0.5, 0) * 0, 0);
}

// The figures that shading/sheen.glsl and docs/shading.md 10e state, against the sum of the formula written out again.
TEST(Sheen, AlbedoFitIsWithinItsError) {
  double squares = 0, worst = 0, worstHalf = 0;
  int count = 0;
  for (int i = 0; i <= 18; ++i)
    for (int k = 0; k <= 18; ++k) {
      const double roughness = 0.07 + 0.93 * i / 18, NoV = 0.02 + 0.98 * k / 18;
      const double truth = std::min(sheenAlbedoBySum(roughness, NoV, 160), 1.0);
      const double error = f64::sheenAlbedoFit(roughness, NoV) - truth;
      squares += error * error;
      worst = std::max(worst, std::abs(error));
      ++count;
    }
  for (int i = 0; i <= 128; ++i)
    for (int k = 0; k <= 128; ++k) {
      const Half roughness(i / 128.0), NoV(k / 128.0);
      const double exact = f64::sheenAlbedoFit(float(roughness), float(NoV));
      worstHalf = std::max(worstHalf, std::abs(float(f16::sheenAlbedoFit(roughness, NoV)) - exact));
    }
  std::printf("albedo of sheen, fit: rms %.4f, max %.4f; half adds %.4f\n", std::sqrt(squares / count), worst,
              worstHalf);
  EXPECT_LT(std::sqrt(squares / count), 0.01);
  EXPECT_LT(worst, 0.0426);
  EXPECT_LT(worstHalf, 0.004);
}

// From 0 to 1, dense towards both ends.
std::vector<double> sheenPlaces() {
  std::vector<double> all = {0, 1e-7, 1e-5, 1e-4, 1e-3, 0.004, 1.0 / 64, 0.03, 1.0 / 16, 0.09, 0.13};
  for (int i = 2; i < 10; ++i) all.push_back(0.1 * i);
  for (const double below : {0.07, 0.02, 4e-3, 1e-3, 1e-4, 1e-6, 0.0}) all.push_back(1 - below);
  return all;
}

// Nothing is NaN, infinite or negative, whatever the precision, with and without denormals; D times what V leaves of
// the light's cosine neither.
#define PARITY_EXPECT_SHEEN_SOUND(space, Real)                                                                         \
  for (const double r : sheenPlaces())                                                                                 \
    for (const double v : sheenPlaces())                                                                               \
      for (const double l : sheenPlaces()) {                                                                           \
        namespace at = shading::space;                                                                                 \
        const Real alpha = at::sheenAlpha(Real(r)), NoV(v), NoL(l);                                                    \
        const Real values[] = {at::D_Charlie(alpha, NoL), at::charlieLambda(alpha, NoV),                               \
                               at::V_Charlie(alpha, NoV, NoL), at::V_Neubelt(NoV, NoL),                                \
                               at::sheenAlbedoFit(Real(r), NoV)};                                                      \
        for (const Real& value : values)                                                                               \
          ASSERT_TRUE(std::isfinite(double(value)) && double(value) >= 0)                                              \
              << #space << ": " << (&value - values) << " of roughness " << r << ", NoV " << v << ", NoL " << l;       \
      }

TEST(Sheen, IsSoundOverItsWholeDomainInEveryPrecision){
    PARITY_EXPECT_SHEEN_SOUND(f64, double) PARITY_EXPECT_SHEEN_SOUND(f32, float) PARITY_EXPECT_SHEEN_SOUND(f16, Half)
        PARITY_EXPECT_SHEEN_SOUND(flushedSheen, FlushedHalf)}

// What half costs, as a result: the lobe against f64 at the same halves, where it is above 1/1024.
TEST(Sheen, LosesLittleInHalf) {
  double lobe = 0, neubelt = 0;
  for (int i = 5; i <= 64; ++i)
    for (int k = 1; k <= 32; ++k)
      for (int m = 1; m <= 32; ++m)
        for (int h = 0; h <= 16; ++h) {
          const Half roughness(i / 64.0), alpha = f16::sheenAlpha(roughness), NoV(k / 32.0), NoL(m / 32.0),
                                          NoH(h / 17.0);
          const double D = f64::D_Charlie(float(alpha), float(NoH));
          const double exact = D * f64::V_Charlie(float(alpha), float(NoV), float(NoL)) * float(NoL);
          if (exact < 0x1p-10) continue;
          const Half value = f16::D_Charlie(alpha, NoH) * (f16::V_Charlie(alpha, NoV, NoL) * NoL);
          lobe = std::max(lobe, std::abs(float(value) / exact - 1));
          const double V = f64::V_Neubelt(float(NoV), float(NoL));
          neubelt = std::max(neubelt, std::abs(float(f16::V_Neubelt(NoV, NoL)) / V - 1));
        }
  std::printf("half against f64, relative: D V NoL %.4f, V_Neubelt %.4f\n", lobe, neubelt);
  EXPECT_LT(lobe, 0.04);
  EXPECT_LT(neubelt, 0.001);
}

} // namespace
} // namespace parity::tests
