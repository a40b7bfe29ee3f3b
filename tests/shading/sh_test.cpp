// Spherical harmonics against numerical integration over the sphere.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/quadrature.h"
#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;
using f64::real3;
using std::numbers::pi;

double dot(const real3& a, const real3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// The integral over the sphere of f(direction), exact for polynomials of degree 23.
template <typename F> double integrateSphere(F f) {
  const GaussRule z(12);
  constexpr int kAround = 24;
  double sum = 0;
  for (std::size_t i = 0; i < z.nodes.size(); ++i)
    for (int k = 0; k < kAround; ++k) {
      const double s = std::sqrt(1 - z.nodes[i] * z.nodes[i]), phi = 2 * pi * (k + 0.5) / kAround;
      sum += z.weights[i] * 2 * pi / kAround * f(real3(s * std::cos(phi), s * std::sin(phi), z.nodes[i]));
    }
  return sum;
}

// The integral of radiance times cosine over the hemisphere around n, in a frame whose pole is n.
template <typename L> double integrateIrradiance(const real3& n, L radiance) {
  const real3 side = std::fabs(n.z) < 0.9 ? real3(0, 0, 1) : real3(1, 0, 0);
  const real3 cross(n.y * side.z - n.z * side.y, n.z * side.x - n.x * side.z, n.x * side.y - n.y * side.x);
  const real3 t = f64::safeNormalize(cross, {1, 0, 0});
  const real3 b(n.y * t.z - n.z * t.y, n.z * t.x - n.x * t.z, n.x * t.y - n.y * t.x);
  const PanelRule cosine({0.0, 1.0}, 12);
  constexpr int kAround = 24;
  double sum = 0;
  for (std::size_t i = 0; i < cosine.nodes.size(); ++i)
    for (int k = 0; k < kAround; ++k) {
      const double c = cosine.nodes[i], s = std::sqrt(1 - c * c), phi = 2 * pi * (k + 0.5) / kAround;
      const double x = s * std::cos(phi), y = s * std::sin(phi);
      const real3 w(x * t.x + y * b.x + c * n.x, x * t.y + y * b.y + c * n.y, x * t.z + y * b.z + c * n.z);
      sum += cosine.weights[i] * 2 * pi / kAround * c * radiance(w);
    }
  return sum;
}

// Irradiance coefficients by the definition in sh.glsl: projection of the radiance, times the cosine kernel.
template <typename L> f64::IrradianceSh project(L radiance) {
  f64::IrradianceSh sh;
  for (int i = 0; i < 9; ++i) {
    const int band = i == 0 ? 0 : i < 4 ? 1 : 2;
    const double c =
        f64::shCosineKernel(band) * integrateSphere([&](const real3& w) { return radiance(w) * f64::shBasis(w).y[i]; });
    sh.c[i] = real3(c, 2 * c, 0);
  }
  return sh;
}

TEST(ShBasis, IsOrthonormalOverTheSphere) {
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 9; ++k) {
      const double product = integrateSphere([&](const real3& w) {
        const f64::ShBasis b = f64::shBasis(w);
        return b.y[i] * b.y[k];
      });
      EXPECT_NEAR(product, i == k ? 1 : 0, 1e-12) << i << ", " << k;
    }
}

TEST(ShBasis, OrdersItsLobesAsDocumented) {
  // The axes each lobe is positive along: l = 1 is y, z, x; 3z^2-1 is 6, xy, yz, xz are 4, 5, 7, x^2-y^2 is 8.
  EXPECT_GT(f64::shBasis({0, 1, 0}).y[1], 0);
  EXPECT_GT(f64::shBasis({0, 0, 1}).y[2], 0);
  EXPECT_GT(f64::shBasis({1, 0, 0}).y[3], 0);
  const double d = std::sqrt(0.5);
  EXPECT_NEAR(f64::shBasis({d, d, 0}).y[4], 0.5 * std::sqrt(15 / pi) / 2, 1e-12);
  EXPECT_NEAR(f64::shBasis({0, d, d}).y[5], 0.5 * std::sqrt(15 / pi) / 2, 1e-12);
  EXPECT_NEAR(f64::shBasis({0, 0, 1}).y[6], 0.25 * std::sqrt(5 / pi) * 2, 1e-12);
  EXPECT_NEAR(f64::shBasis({d, 0, d}).y[7], 0.5 * std::sqrt(15 / pi) / 2, 1e-12);
  EXPECT_NEAR(f64::shBasis({1, 0, 0}).y[8], 0.25 * std::sqrt(15 / pi), 1e-12);
}

// A_l = 2 pi integral of c P_l(c) dc over [0, 1], with Legendre's polynomials.
TEST(ShCosineKernel, IsTheZonalProjectionOfTheClampedCosine) {
  const PanelRule cosine({0.0, 1.0}, 8);
  double a[3] = {0, 0, 0};
  for (std::size_t i = 0; i < cosine.nodes.size(); ++i) {
    const double c = cosine.nodes[i], w = 2 * pi * cosine.weights[i] * c;
    a[0] += w;
    a[1] += w * c;
    a[2] += w * (3 * c * c - 1) / 2;
  }
  for (int band = 0; band < 3; ++band) EXPECT_NEAR(f64::shCosineKernel(band), a[band], 1e-14);
}

// Radiance of degree 2 has nothing in the bands that order 2 drops, so irradiance comes out exactly.
TEST(EvalIrradianceSH, EqualsTheHemisphereIntegralForQuadraticRadiance) {
  const auto radiance = [](const real3& w) {
    return 2 + 0.3 * w.x - 0.7 * w.y + 0.4 * w.z + 0.5 * w.x * w.y - 0.6 * w.y * w.z + 0.2 * w.z * w.z +
           0.3 * w.x * w.z - 0.4 * (w.x * w.x - w.y * w.y);
  };
  const f64::IrradianceSh sh = project(radiance);
  for (const real3& direction :
       {real3(1, 0, 0), real3(0, -1, 0), real3(0, 0, 1), real3(1, 2, -3), real3(-0.5, 0.1, 2)}) {
    const real3 n = f64::safeNormalize(direction, {0, 0, 1});
    ASSERT_NEAR(dot(n, n), 1, 1e-14);
    const double expected = integrateIrradiance(n, radiance);
    const real3 actual = f64::evalIrradianceSH(sh, n);
    EXPECT_NEAR(actual.x, expected, 1e-12);
    EXPECT_NEAR(actual.y, 2 * expected, 1e-12);
    EXPECT_EQ(actual.z, 0);
  }
}

TEST(EvalIrradianceSH, OfAUniformSkyIsPiTimesItsRadiance) {
  const f64::IrradianceSh sh = project([](const real3&) { return 0.8; });
  EXPECT_NEAR(f64::evalIrradianceSH(sh, {0, 0.6, 0.8}).x, 0.8 * pi, 1e-12);
}

TEST(EvalIrradianceSH, IsNeverNegativeBehindASmallSource) {
  f64::IrradianceSh sh; // a point source along z: each coefficient is the kernel times the basis at z
  for (int i = 0; i < 9; ++i) {
    const double c = f64::shCosineKernel(i == 0 ? 0 : i < 4 ? 1 : 2) * f64::shBasis({0, 0, 1}).y[i];
    sh.c[i] = real3(c, c, c);
  }
  // The series itself is 1/4 + P1/2 + 5/16 P2 at cosine c: -0.0542 at c = -0.5333.
  const double c = -0.5333, s = std::sqrt(1 - c * c);
  EXPECT_LT(0.25 + 0.5 * c + 0.3125 * (1.5 * c * c - 0.5), 0);
  EXPECT_EQ(f64::evalIrradianceSH(sh, {s, 0, c}).x, 0);
  EXPECT_NEAR(f64::evalIrradianceSH(sh, {0, 0, 1}).x, 0.25 + 0.5 + 0.3125, 1e-12);
}

} // namespace
} // namespace parity::tests
