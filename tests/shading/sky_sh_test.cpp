// The mobile sky light: SH irradiance over pi with 4 and 9 coefficients.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "shading/shading.h"

namespace parity::tests {
namespace {

namespace f64 = shading::f64;

f64::IrradianceSh someCoefficients() {
  f64::IrradianceSh sh;
  for (int i = 0; i < 9; ++i) sh.c[i] = {5.0 - i, 4 + 0.25 * i * (i % 2 == 0 ? 1 : -1), 3 + 0.1 * i};
  return sh;
}

f64::real3 direction(double z, double phi) {
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

TEST(SkySh, NineCoefficientsAreTheIrradianceOverPi) {
  const f64::IrradianceSh sh = someCoefficients();
  const f64::SkySh sky = f64::packSkySh(sh, 9);
  for (double z = -1; z <= 1; z += 0.125)
    for (double phi = 0; phi < 6; phi += 0.5) {
      const f64::real3 n = direction(z, phi), E = f64::evalIrradianceSH(sh, n), actual = f64::GetSkySHDiffuse(sky, n);
      EXPECT_NEAR(actual.x, E.x / std::numbers::pi, 1e-12);
      EXPECT_NEAR(actual.y, E.y / std::numbers::pi, 1e-12);
      EXPECT_NEAR(actual.z, E.z / std::numbers::pi, 1e-12);
    }
}

// A sky of radiance 1 + n.a: its first two bands are all of it, and the cosine kernel turns 1 + n.a into 1 + 2/3 n.a.
TEST(SkySh, FourCoefficientsAreExactForALinearSky) {
  const double Y0 = 0.282094791773878143, Y1 = 0.488602511902919921;
  const f64::real3 a(0.3, -0.2, 0.5);
  f64::IrradianceSh sh{};
  const auto set = [&](int i, double radiance, int band) {
    const double c = radiance * f64::shCosineKernel(band);
    sh.c[i] = {c, 2 * c, 0};
  };
  set(0, 1 / Y0, 0);
  set(1, a.y / Y1, 1); // y z x
  set(2, a.z / Y1, 1);
  set(3, a.x / Y1, 1);
  const f64::SkySh sky = f64::packSkySh(sh, 4);
  for (double z = -1; z <= 1; z += 0.125)
    for (double phi = 0; phi < 6; phi += 0.5) {
      const f64::real3 n = direction(z, phi), actual = f64::GetSkySHDiffuseSimple(sky, n);
      const double expected = 1 + 2.0 / 3 * (n.x * a.x + n.y * a.y + n.z * a.z);
      EXPECT_NEAR(actual.x, expected, 1e-12);
      EXPECT_NEAR(actual.y, 2 * expected, 1e-12);
    }
}

// docs/shading.md 7e: W = C0 V0 - C3 V6, V6 of 3 z^2 - 1 with Z up. A sky of radiance 1 + a (3 up^2 - 1) has V6 = a
// times the basis function's norm; the constant loses C3 V6, although nothing else of the band is read.
TEST(SkySh, FourCoefficientsKeepTheSecondBandsPartOfTheConstant) {
  // 3 y^2 - 1 in the basis of shading/sh.glsl: -1/2 of its sixth over .3154, -3/2 of x^2 - y^2 over .5463.
  const double a = 0.2, Y0 = 0.282094791773878143, Y6 = 0.315391565252520006, Y8 = 0.546274215296039535;
  f64::IrradianceSh sh{};
  sh.c[0] = {f64::shCosineKernel(0) / Y0, 0, 0};
  sh.c[6] = {f64::shCosineKernel(2) * -0.5 * a / Y6, 0, 0};
  sh.c[8] = {f64::shCosineKernel(2) * -1.5 * a / Y8, 0, 0};
  const double C3 = std::sqrt(5) / (16 * std::sqrt(std::numbers::pi));
  const f64::SkySh sky = f64::packSkySh(sh, 4);
  EXPECT_NEAR(sky.c[0].x, 1 - C3 * a / Y6, 1e-12);
  EXPECT_NEAR(sky.c[0].x, 1 - a / 4, 1e-12); // the cosine kernel's 1/4 of the horizon's -a
  EXPECT_NEAR(f64::skyMeanRadiance(sh).x, 1, 1e-12) << "the mean is none of its business";
}

// "SH normalised so that L0 = .282095 and the linear factor is .325735" (docs/shading.md 7b), for projected radiance.
TEST(SkySh, FactorsOfTheFirstTwoBandsAreThoseOfTheEngine) {
  f64::IrradianceSh sh{};
  sh.c[0] = {f64::shCosineKernel(0), 0, 0};
  sh.c[3] = {f64::shCosineKernel(1), 0, 0};
  const f64::SkySh sky = f64::packSkySh(sh, 4);
  EXPECT_NEAR(sky.c[0].x, 0.282095, 1e-6);
  EXPECT_NEAR(sky.c[1].x, 0.325735, 1e-6);
}

TEST(SkySh, IsNeverNegativeBehindASmallSource) {
  f64::IrradianceSh sh{};
  sh.c[0] = {1, 1, 1};
  sh.c[2] = {3, 3, 3};
  EXPECT_EQ(f64::GetSkySHDiffuseSimple(f64::packSkySh(sh, 4), {0, 0, -1}).x, 0);
  EXPECT_EQ(f64::GetSkySHDiffuse(f64::packSkySh(sh, 9), {0, 0, -1}).x, 0);
}

} // namespace
} // namespace parity::tests
