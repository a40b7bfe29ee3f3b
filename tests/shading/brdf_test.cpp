// The microfacet functions in double precision against definitions and integrals that do not use them.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
namespace f32 = shading::f32;
using std::numbers::pi;

// Directional albedo at F0 = F90 = 1 of shading/'s own D and V.
double albedo(Geometry geometry, double roughness, double NoV) {
  const double alpha = roughness * roughness;
  return integrateLobe(alpha, NoV, 12, [&](const Cosines& c) {
    const double V = geometry == Geometry::schlickSmith ? f64::V_SchlickSmith(alpha, NoV, c.NoL)
                                                        : f64::V_SmithGGXCorrelated(alpha, NoV, c.NoL);
    return f64::D_GGX(alpha, c.NoH) * V * c.NoL;
  });
}

// Share of white light that a sphere of this roughness loses in a white furnace: 1 - integral of 2 NoV albedo.
double furnaceLossPercent(Geometry geometry, double roughness) {
  const GaussRule rule(16);
  double kept = 0;
  for (int i = 0; i < 16; ++i) {
    const double NoV = 0.5 + 0.5 * rule.nodes[i];
    kept += 0.5 * rule.weights[i] * 2 * NoV * albedo(geometry, roughness, NoV);
  }
  return 100 * (1 - kept);
}

TEST(DGgx, ProjectedAreaIntegratesToOne) {
  for (const double alpha : {0.0025, 0.01, 0.1, 0.5, 1.0}) {
    // tan(theta) = alpha tan(psi) spreads the peak; integral of D NoH over the hemisphere.
    const PanelRule psi({0.0, 0.5, 1.0, 1.4, 1.55, 1.568, pi / 2}, 24);
    double sum = 0;
    for (std::size_t i = 0; i < psi.nodes.size(); ++i) {
      const double theta = std::atan2(alpha * std::sin(psi.nodes[i]), std::cos(psi.nodes[i]));
      const double slope = alpha / (std::pow(alpha * std::sin(psi.nodes[i]), 2) + std::pow(std::cos(psi.nodes[i]), 2));
      sum += psi.weights[i] * slope * std::sin(theta) * 2 * pi * std::cos(theta) * f64::D_GGX(alpha, std::cos(theta));
    }
    EXPECT_NEAR(sum, 1, 1e-9) << "alpha " << alpha;
  }
}

TEST(DGgx, IsTheTextbookForm) {
  for (const double alpha : {0.01, 0.3, 1.0})
    for (const double NoH : {0.0, 0.3, 0.9, 0.999, 1.0})
      EXPECT_NEAR(f64::D_GGX(alpha, NoH) / distribution(alpha, NoH), 1, 1e-9);
  EXPECT_DOUBLE_EQ(f64::D_GGX(0.5, 1.0), 4 / pi); // peak: 1 / (pi alpha^2)
}

TEST(DGgx, IsFiniteWhereTheMirrorsPeakIsZeroOverZero) {
  EXPECT_EQ(f64::D_GGX(0, 1), 0);
  EXPECT_EQ(f32::D_GGX(0, 1), 0);
  EXPECT_EQ(float(shading::f16::D_GGX(shading::Half(0), shading::Half(1))), 0);
}

TEST(Visibility, IsMaskingShadowingOverFourCosines) {
  for (const double alpha : {0.01, 0.25, 1.0})
    for (const double NoV : {0.02, 0.4, 1.0})
      for (const double NoL : {0.05, 0.7, 1.0}) {
        const double denominator = 4 * NoV * NoL;
        EXPECT_NEAR(f64::V_SmithGGXCorrelated(alpha, NoV, NoL) * denominator,
                    maskingShadowing(Geometry::heightCorrelated, alpha, NoV, NoL), 1e-12);
        EXPECT_NEAR(f64::V_SchlickSmith(alpha, NoV, NoL) * denominator,
                    maskingShadowing(Geometry::schlickSmith, alpha, NoV, NoL), 1e-12);
      }
}

// Heitz 2014, eq. 14: the projected area of the visible microfacets is the projected area of the surface. With the
// light along the normal nothing is shadowed, so G1(v) = 4 NoV V(v, n).
TEST(Visibility, SmithMaskingConservesProjectedArea) {
  for (const double alpha : {0.1, 0.5, 1.0})
    for (const double NoV : {0.2, 0.6, 0.95}) {
      const double G1 = 4 * NoV * f64::V_SmithGGXCorrelated(alpha, NoV, 1);
      const double sinV = std::sqrt(1 - NoV * NoV);
      const PanelRule theta({0.0, 0.2, 0.6, 1.0, 1.3, 1.5, pi / 2}, 16), phi({0.0, 0.8, pi / 2, 2.3, pi}, 64);
      double area = 0;
      for (std::size_t i = 0; i < theta.nodes.size(); ++i)
        for (std::size_t k = 0; k < phi.nodes.size(); ++k) {
          const double NoH = std::cos(theta.nodes[i]), sinH = std::sin(theta.nodes[i]);
          const double VoH = sinV * sinH * std::cos(phi.nodes[k]) + NoV * NoH;
          area += 2 * theta.weights[i] * phi.weights[k] * sinH * std::max(VoH, 0.0) * f64::D_GGX(alpha, NoH);
        }
      EXPECT_NEAR(G1 * area, NoV, 1e-4) << "alpha " << alpha << ", NoV " << NoV;
    }
}

TEST(Visibility, IsFiniteAtGrazingAndZeroAlphaInEveryPrecision) {
  for (const double alpha : {0.0, 0.01, 1.0})
    for (const double cosine : {0.0, 1.0}) {
      EXPECT_TRUE(std::isfinite(f64::V_SmithGGXCorrelated(alpha, 0, cosine)));
      EXPECT_TRUE(std::isfinite(f64::V_SchlickSmith(alpha, 0, cosine)));
      EXPECT_TRUE(std::isfinite(f32::V_SmithGGXCorrelated(float(alpha), 0, float(cosine))));
      EXPECT_TRUE(std::isfinite(f32::V_SchlickSmith(float(alpha), 0, float(cosine))));
      const shading::Half a(alpha), x(cosine), zero(0);
      EXPECT_TRUE(std::isfinite(float(shading::f16::V_SmithGGXCorrelated(a, zero, x))));
      EXPECT_TRUE(std::isfinite(float(shading::f16::V_SchlickSmith(a, zero, x))));
    }
}

// docs/shading.md 1a: in closed form for Schlick-Smith, where D and G cancel at alpha = 1.
TEST(WhiteFurnace, RoughestSurfaceSeenHeadOnReflectsOneMinusLn2) {
  EXPECT_NEAR(albedo(Geometry::schlickSmith, 1, 1), 1 - std::numbers::ln2, 1e-12);
}

// docs/shading.md 5, single scattering. Its figures are printed to 0.1 and are up to 0.12 off these converged ones.
TEST(WhiteFurnace, LosesWhatIsKnownOfBothGeometryTerms) {
  struct Loss {
    double roughness, schlickSmith, heightCorrelated;
  };
  for (const Loss& loss : {Loss{0.2, 3.6, 0.6}, Loss{0.4, 13.0, 5.9}, Loss{0.6, 27.8, 19.8}, Loss{0.8, 45.4, 39.7},
                           Loss{1.0, 62.3, 59.1}}) {
    EXPECT_NEAR(furnaceLossPercent(Geometry::schlickSmith, loss.roughness), loss.schlickSmith, 0.15);
    EXPECT_NEAR(furnaceLossPercent(Geometry::heightCorrelated, loss.roughness), loss.heightCorrelated, 0.15);
  }
}

TEST(EnergyCompensation, RestoresAWhiteMetalExactly) {
  for (const double roughness : {0.3, 1.0}) {
    const EnvBrdf e = integrateEnvBrdf(Geometry::heightCorrelated, roughness, 0.5);
    const f64::real3 factor = f64::energyCompensation({1, 1, 1}, {e.A, e.B});
    EXPECT_NEAR((e.A + e.B) * factor.x, 1, 1e-12);
    EXPECT_EQ(f64::energyCompensation({0, 0, 0}, {e.A, e.B}).y, 1); // what reflects nothing loses nothing
  }
  EXPECT_TRUE(std::isfinite(f32::energyCompensation({1, 1, 1}, {0, 0}).z));
}

TEST(FSchlick, RunsFromF0ToOne) {
  const f64::real3 F0(0.04, 0.5, 1);
  const f64::real3 head = f64::F_Schlick(F0, 1), graze = f64::F_Schlick(F0, 0), between = f64::F_Schlick(F0, 0.5);
  EXPECT_EQ(head.x, 0.04);
  EXPECT_EQ(head.y, 0.5);
  EXPECT_EQ(graze.x, 1);
  EXPECT_EQ(graze.y, 1);
  EXPECT_NEAR(between.x, 0.04 + 0.96 * std::pow(0.5, 5), 1e-15);
  EXPECT_NEAR(between.z, 1, 1e-15);
}

// By Snell's law and the amplitudes of both polarisations.
TEST(FresnelWeights, DielectricIsFresnelsReflectanceOfIndexOneAndAHalf) {
  for (const double c : {0.0, 0.05, 0.3, 0.7, 1.0}) {
    const double t = std::sqrt(1 - (1 - c * c) / 2.25);
    const double s = (c - 1.5 * t) / (c + 1.5 * t), p = (1.5 * c - t) / (1.5 * c + t);
    EXPECT_NEAR(0.04 + 0.96 * f64::dielectricWeight(c), 0.5 * (s * s + p * p), 1e-12) << c;
  }
}

TEST(FresnelWeights, RunFromOneToNearlyZeroAndStayCloseToSchlick) {
  for (int i = 0; i <= 1000; ++i) {
    const double c = i / 1000.0, schlick = std::pow(1 - c, 5);
    EXPECT_NEAR(f64::schlickWeight(c), schlick, 1e-15);
    EXPECT_NEAR(f64::sphericalGaussianWeight(c), schlick, 0.004);
    EXPECT_NEAR(f64::dielectricWeight(c), schlick, 0.04);
    EXPECT_GE(f64::dielectricWeight(c), 0);
  }
  EXPECT_EQ(f64::sphericalGaussianWeight(0), 1);
  EXPECT_NEAR(f64::dielectricWeight(0), 1, 1e-15);
  EXPECT_NEAR(f64::dielectricWeight(1), 0, 1e-15);
}

TEST(FresnelWeights, MeansAreTheCosineWeightedIntegrals) {
  const GaussRule rule(64);
  double schlick = 0, gaussian = 0, dielectric = 0;
  for (int i = 0; i < 64; ++i) {
    const double mu = 0.5 + 0.5 * rule.nodes[i], weight = rule.weights[i] * mu;
    schlick += weight * f64::schlickWeight(mu);
    gaussian += weight * f64::sphericalGaussianWeight(mu);
    dielectric += weight * f64::dielectricWeight(mu);
  }
  EXPECT_NEAR(f64::schlickMean(), schlick, 1e-9);
  EXPECT_NEAR(f64::sphericalGaussianMean(), gaussian, 1e-9);
  EXPECT_NEAR(f64::dielectricMean(), dielectric, 1e-9);
}

TEST(AlbedoScaling, LeavesWhatIsNotReflectedAndIsNeverNegative) {
  const f64::real3 rest = f64::albedoScaling({0.25, 1.0, 1.0000001});
  EXPECT_EQ(rest.x, 0.75);
  EXPECT_EQ(rest.y, 0);
  EXPECT_EQ(rest.z, 0);
}

// Both models of multiple scattering close the furnace of a white metal, whatever the roughness.
TEST(MultipleScattering, GivesAWhiteMetalWhatSingleScatteringLoses) {
  for (const double roughness : {0.2, 0.6, 1.0}) {
    const EnvBrdf e = integrateEnvBrdf(Geometry::heightCorrelated, roughness, 0.4);
    const double Eavg = 1 - furnaceLossPercent(Geometry::heightCorrelated, roughness) / 100;
    const f64::real3 white(1, 1, 1);
    EXPECT_NEAR(f64::fdezAgueraAlbedo(white, 1, white, {e.A, e.B}).x, 1 - e.A - e.B, 1e-12);
    EXPECT_NEAR(f64::kullaContyAlbedo(white, e.A + e.B, Eavg).x, 1 - e.A - e.B, 1e-12);
  }
  EXPECT_TRUE(std::isfinite(f32::kullaContyLobe(1, 1)));
  // A smooth surface: its average is 1 by rounding, and at grazing something is lost all the same.
  EXPECT_LT(f32::kullaContyLobe(0.9f, 1.f), 1000);
}

// The lobe sends out, over all lights, what the albedo says: integral of lobe NoL over the hemisphere is 1.
TEST(MultipleScattering, LobeOfKullaAndContyIntegratesToOne) {
  constexpr double kRoughness = 0.7;
  const double Eavg = 1 - furnaceLossPercent(Geometry::heightCorrelated, kRoughness) / 100;
  const GaussRule rule(48);
  double sum = 0;
  for (int i = 0; i < 48; ++i) {
    const double mu = 0.5 + 0.5 * rule.nodes[i];
    sum += 0.5 * rule.weights[i] * 2 * pi * mu *
           f64::kullaContyLobe(albedo(Geometry::heightCorrelated, kRoughness, mu), Eavg);
  }
  EXPECT_NEAR(sum, 1, 1e-3); // furnaceLossPercent's own 16 nodes
}

// Few bounces, summed one by one: each reflects Favg, a share Eavg of which leaves.
TEST(MultipleScattering, ColouredBouncesAddUp) {
  constexpr double kF = 0.6, kE = 0.55, kEavg = 0.5;
  double sum = 0, onItsWay = (1 - kE) * kF * kF;
  for (int i = 0; i < 100; ++i, onItsWay *= kF * (1 - kEavg)) sum += onItsWay * kEavg;
  EXPECT_NEAR(f64::kullaContyAlbedo({kF, 1, 0}, kE, kEavg).x, sum, 1e-12);
  // Fdez-Aguera: Fss Favg (1 - E) / (1 - Favg (1 - E)) with Fss = F0 A + F90 B.
  const f64::real3 F0(0.5, 0.5, 0.5), Favg(kF, kF, kF);
  EXPECT_NEAR(f64::fdezAgueraAlbedo(F0, 0.9, Favg, {0.4, 0.15}).y,
              (0.5 * 0.4 + 0.9 * 0.15) * kF * 0.45 / (1 - kF * 0.45), 1e-12);
}

TEST(FdLambert, ReflectsAWhiteSkyWhole) { EXPECT_NEAR(f64::Fd_Lambert() * pi, 1, 1e-15); }

} // namespace
} // namespace parity::tests
