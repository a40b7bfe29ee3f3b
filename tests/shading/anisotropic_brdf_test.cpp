// The stretched GGX lobe against definitions and integrals that do not use it, and in half precision.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "shading/direction.h"
#include "shading/flushed_half.h"
#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::shading {
// anisotropic_brdf.glsl alone, once more.
#define FN inline
#define CONSTANT inline constexpr
#define PRECISE
#define R(x) real(x)
namespace flushedAnisotropic {
using real = tests::FlushedHalf;
inline constexpr real kSmallest(0x1p-14), kLargest(65504.0), kInvPi(0.318309886183790672);
#define PARITY_SHADING_REAL
#undef PARITY_SHADING_ANISOTROPIC_BRDF
#include "shading/anisotropic_brdf.glsl"
#undef PARITY_SHADING_REAL
} // namespace flushedAnisotropic
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

Direction along(double cosine, double phi) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}
Direction halfway(const Direction& a, const Direction& b) {
  const double x = a.x + b.x, y = a.y + b.y, z = a.z + b.z, length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

struct Stretch {
  double alphaT, alphaB;
};
const Stretch kStretches[] = {{0.3, 0.3}, {0.5, 0.1}, {1, 0.05}, {0.2, 0.02}, {1, 1}};

// The integral of f(h) over half vectors; slopes alpha tan(psi) spread each axis by its own alpha.
template <typename F> double integrateHalfVectors(const Stretch& s, const F& f) {
  const PanelRule psi({0.0, 0.4, 0.9, 1.3, 1.5, 1.56, pi / 2}, 16), phi({0.0, pi / 2, pi, 3 * pi / 2, 2 * pi}, 48);
  double sum = 0;
  for (std::size_t i = 0; i < psi.nodes.size(); ++i)
    for (std::size_t k = 0; k < phi.nodes.size(); ++k) {
      const double slope = std::tan(psi.nodes[i]), cosine = std::cos(psi.nodes[i]);
      const double x = s.alphaT * slope * std::cos(phi.nodes[k]), y = s.alphaB * slope * std::sin(phi.nodes[k]);
      const double z = 1 / std::sqrt(1 + x * x + y * y);
      // dh = z^3 dx dy, dx dy = alphaT alphaB slope dslope dphi, dslope = dpsi / cos^2.
      const double measure = z * z * z * s.alphaT * s.alphaB * slope / (cosine * cosine);
      sum += psi.weights[i] * phi.weights[k] * measure * f(Direction{x * z, y * z, z});
    }
  return sum;
}

double distributionAt(const Stretch& s, const Direction& h) {
  return f64::D_GGXAnisotropic(s.alphaT, s.alphaB, h.x, h.y, h.z);
}
double visibilityAt(const Stretch& s, const Direction& v, const Direction& l) {
  return f64::V_SmithGGXAnisotropic(s.alphaT, s.alphaB, v.x, v.y, v.z, l.x, l.y, l.z);
}

TEST(Anisotropy, AlphaRunsFromTheSurfacesToOne) {
  for (const double alpha : {0.0, 0.04, 0.5, 1.0}) {
    EXPECT_EQ(f64::anisotropicAlpha(alpha, 0), alpha);
    EXPECT_EQ(f64::anisotropicAlpha(alpha, 1), 1);
    EXPECT_DOUBLE_EQ(f64::anisotropicAlpha(alpha, 0.5), 0.75 * alpha + 0.25);
  }
}

TEST(Anisotropy, ProjectedAreaIntegratesToOne) {
  for (const Stretch& s : kStretches)
    EXPECT_NEAR(integrateHalfVectors(s, [&](const Direction& h) { return distributionAt(s, h) * h.z; }), 1, 1e-9)
        << s.alphaT << " " << s.alphaB;
}

TEST(Anisotropy, DistributionIsTheTextbookForm) {
  for (const Stretch& s : kStretches)
    for (const double cosine : {0.01, 0.5, 0.99, 1.0})
      for (const double phi : {0.0, 0.7, pi / 2, 4.0}) {
        const Direction h = along(cosine, phi);
        const double w = std::pow(h.x / s.alphaT, 2) + std::pow(h.y / s.alphaB, 2) + h.z * h.z;
        EXPECT_NEAR(distributionAt(s, h) * (pi * s.alphaT * s.alphaB * w * w), 1, 1e-12);
      }
}

// Heitz 2014, eq. 14: the visible microfacets have the projected area of the surface. With the light along the normal
// nothing is shadowed, so G1(v) = 4 NoV V(v, n).
TEST(Anisotropy, SmithMaskingConservesProjectedArea) {
  for (const Stretch& s : {Stretch{0.5, 0.1}, Stretch{1, 0.2}, Stretch{0.3, 0.3}})
    for (const double NoV : {0.2, 0.6, 0.95})
      for (const double phi : {0.0, 0.6, pi / 2}) {
        const Direction v = along(NoV, phi);
        const double G1 = 4 * NoV * visibilityAt(s, v, {0, 0, 1});
        const double area = integrateHalfVectors(
            s, [&](const Direction& h) { return distributionAt(s, h) * std::max(dot(v, h), 0.0); });
        EXPECT_NEAR(G1 * area, NoV, 2e-3 * NoV) << s.alphaT << " " << s.alphaB << " " << NoV << " " << phi;
      }
}

// Along V the stretched lobe masks like the round one of the projected alpha (Heitz 2014, eq. 86).
TEST(Anisotropy, MaskingIsThatOfTheProjectedAlpha) {
  for (const Stretch& s : kStretches)
    for (const double NoV : {0.05, 0.5, 0.99})
      for (const double phi : {0.0, 0.6, 1.4, pi / 2, 3.0}) {
        const Direction v = along(NoV, phi);
        const double alpha = f64::projectedAlpha(s.alphaT, s.alphaB, v.x, v.y);
        EXPECT_NEAR(f64::anisotropicLength(s.alphaT, s.alphaB, v.x, v.y, NoV),
                    std::sqrt(alpha * alpha * (1 - NoV * NoV) + NoV * NoV), 1e-12);
        const double c = std::cos(phi), n = std::sin(phi);
        EXPECT_NEAR(alpha, std::sqrt(s.alphaT * s.alphaT * c * c + s.alphaB * s.alphaB * n * n), 1e-12);
      }
  EXPECT_DOUBLE_EQ(f64::projectedAlpha(0.5, 0.1, 0, 0), std::sqrt(0.13)) << "at the normal: both alike";
  EXPECT_DOUBLE_EQ(f64::projectedAlpha(0.5, 0.1, 1e-200, 0), 0.5);
  EXPECT_EQ(f64::projectedAlpha(0, 0, 0.3, 0.4), 0);
}

TEST(Anisotropy, EqualAlphasGiveTheRoundLobe) {
  for (const double alpha : {1e-6, 0.01, 0.3, 1.0})
    for (const double NoV : {0.01, 0.4, 1.0})
      for (const double NoL : {0.02, 0.7, 1.0})
        for (const double phi : {0.1, 2.0}) {
          const Direction v = along(NoV, 0.4), l = along(NoL, phi), h = halfway(v, l);
          const Stretch s{alpha, alpha};
          EXPECT_NEAR(distributionAt(s, h) / f64::D_GGX(alpha, h.z), 1, 1e-9);
          EXPECT_NEAR(visibilityAt(s, v, l) / f64::V_SmithGGXCorrelated(alpha, NoV, NoL), 1, 1e-12);
          EXPECT_EQ(f64::projectedAlpha(alpha, alpha, v.x, v.y), alpha);
          EXPECT_EQ(f64::V_SchlickSmithAnisotropic(alpha, alpha, NoV, NoL), f64::V_SchlickSmith(alpha, NoV, NoL));
        }
}

// A white furnace gets no more than all: E = integral over h of D V 4 VoH NoL dh <= 1, for both geometry terms.
TEST(Anisotropy, WhiteFurnaceIsBoundedByOne) {
  for (const Stretch& s : kStretches)
    for (const double NoV : {0.1, 0.5, 1.0})
      for (const double phi : {0.0, 0.8, pi / 2}) {
        const Direction v = along(NoV, phi);
        const double alphaV = f64::projectedAlpha(s.alphaT, s.alphaB, v.x, v.y);
        double E[2] = {};
        for (const bool smith : {true, false})
          E[smith ? 0 : 1] = integrateHalfVectors(s, [&](const Direction& h) {
            const double VoH = dot(v, h);
            const Direction l{2 * VoH * h.x - v.x, 2 * VoH * h.y - v.y, 2 * VoH * h.z - v.z};
            if (VoH <= 0 || l.z <= 0) return 0.0;
            const double V = smith ? visibilityAt(s, v, l)
                                   : f64::V_SchlickSmithAnisotropic(
                                         alphaV, f64::projectedAlpha(s.alphaT, s.alphaB, l.x, l.y), NoV, l.z);
            return distributionAt(s, h) * V * 4 * VoH * l.z;
          });
        EXPECT_LT(E[0], 1 + 1e-3);
        EXPECT_GT(E[0], 0.3);
        EXPECT_LT(E[1], 1 + 1e-3);
        EXPECT_GT(E[1], 0.2);
      }
}

// From 0 to 1, dense towards both ends.
std::vector<double> anisotropicPlaces() {
  return {0, 1e-5, 1e-4, 2.44140625e-4, 1e-3, 0.0078, 1.0 / 64, 0.06, 0.2, 0.5, 0.8, 0.96, 0.996, 0.9995, 1};
}

// Nothing is NaN, infinite or negative, whatever the precision, with and without denormals.
#define PARITY_EXPECT_ANISOTROPIC_SOUND(space, Real)                                                                   \
  for (const double alpha : anisotropicPlaces())                                                                       \
    for (const double strength : {0.0, 0.02, 0.3, 1.0})                                                                \
      for (const double v : anisotropicPlaces())                                                                       \
        for (const double l : anisotropicPlaces())                                                                     \
          for (const double phi : {0.0, 0.01, 1.0, pi / 2, 3.0}) {                                                     \
            namespace at = shading::space;                                                                             \
            const Real alphaB(alpha), alphaT = at::anisotropicAlpha(alphaB, Real(strength));                           \
            const Direction V = along(v, phi), L = along(l, 1 - phi);                                                  \
            const Real ToV(V.x), BoV(V.y), NoV(V.z), ToL(L.x), BoL(L.y), NoL(L.z);                                     \
            const Real alphaV = at::projectedAlpha(alphaT, alphaB, ToV, BoV);                                          \
            const Real alphaL = at::projectedAlpha(alphaT, alphaB, ToL, BoL);                                          \
            const Real D = at::D_GGXAnisotropic(alphaT, alphaB, ToL, BoL, NoL);                                        \
            const Real Vis = at::V_SmithGGXAnisotropic(alphaT, alphaB, ToV, BoV, NoV, ToL, BoL, NoL);                  \
            const Real values[] = {                                                                                    \
                alphaT, D, Vis, Vis * NoL, alphaV, alphaL, at::V_SchlickSmithAnisotropic(alphaV, alphaL, NoV, NoL)};   \
            for (const Real& value : values)                                                                           \
              ASSERT_TRUE(std::isfinite(double(value)) && double(value) >= 0)                                          \
                  << #space << ": " << (&value - values) << " of alpha " << alpha << ", strength " << strength         \
                  << ", NoV " << v << ", NoL " << l << ", phi " << phi;                                                \
          }

TEST(Anisotropy, IsSoundOverItsWholeDomainInEveryPrecision){
    PARITY_EXPECT_ANISOTROPIC_SOUND(f64, double) PARITY_EXPECT_ANISOTROPIC_SOUND(f32, float)
        PARITY_EXPECT_ANISOTROPIC_SOUND(f16, Half) PARITY_EXPECT_ANISOTROPIC_SOUND(flushedAnisotropic, FlushedHalf)}

// What half costs, as a result: D V NoL against f64 at the same halves, from roughness .1 on.
TEST(Anisotropy, LosesLittleInHalf) {
  double worst = 0;
  for (const double roughness : {0.1, 0.2, 0.4, 0.7, 1.0})
    for (const double strength : {0.0, 0.3, 0.7, 1.0})
      for (int i = 1; i <= 12; ++i)
        for (int k = 1; k <= 12; ++k)
          for (int m = 0; m < 12; ++m) {
            const Half alphaB(roughness * roughness), alphaT = f16::anisotropicAlpha(alphaB, Half(strength));
            const Direction V = along(i / 12.0, 0.7), L = along(k / 12.0, m * pi / 6), H = halfway(V, L);
            const Half v[] = {Half(V.x), Half(V.y), Half(V.z)}, l[] = {Half(L.x), Half(L.y), Half(L.z)},
                       h[] = {Half(H.x), Half(H.y), Half(H.z)};
            const double exact = f64::D_GGXAnisotropic(alphaT, alphaB, h[0], h[1], h[2]) *
                                 f64::V_SmithGGXAnisotropic(alphaT, alphaB, v[0], v[1], v[2], l[0], l[1], l[2]) *
                                 float(l[2]);
            if (exact < 0x1p-10) continue;
            const Half value = f16::D_GGXAnisotropic(alphaT, alphaB, h[0], h[1], h[2]) *
                               (f16::V_SmithGGXAnisotropic(alphaT, alphaB, v[0], v[1], v[2], l[0], l[1], l[2]) * l[2]);
            worst = std::max(worst, std::abs(float(value) / exact - 1));
          }
  std::printf("anisotropic D V NoL, half against f64, relative: %.4f\n", worst);
  EXPECT_LT(worst, 0.02);
}

} // namespace
} // namespace parity::tests
