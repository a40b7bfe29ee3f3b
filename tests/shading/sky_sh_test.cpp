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

TEST(SkySh, nineCoefficientsAreTheIrradianceOverPi) {
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
TEST(SkySh, fourCoefficientsAreExactForALinearSky) {
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

// "SH normalised so that L0 = .282095 and the linear factor is .325735" (SHADING 7), for projected radiance.
TEST(SkySh, factorsOfTheFirstTwoBandsAreThoseOfTheEngine) {
  f64::IrradianceSh sh{};
  sh.c[0] = {f64::shCosineKernel(0), 0, 0};
  sh.c[3] = {f64::shCosineKernel(1), 0, 0};
  const f64::SkySh sky = f64::packSkySh(sh, 4);
  EXPECT_NEAR(sky.c[0].x, 0.282095, 1e-6);
  EXPECT_NEAR(sky.c[1].x, 0.325735, 1e-6);
}

TEST(SkySh, isNeverNegativeBehindASmallSource) {
  f64::IrradianceSh sh{};
  sh.c[0] = {1, 1, 1};
  sh.c[2] = {3, 3, 3};
  EXPECT_EQ(f64::GetSkySHDiffuseSimple(f64::packSkySh(sh, 4), {0, 0, -1}).x, 0);
  EXPECT_EQ(f64::GetSkySHDiffuse(f64::packSkySh(sh, 9), {0, 0, -1}).x, 0);
}

} // namespace
} // namespace parity::tests
