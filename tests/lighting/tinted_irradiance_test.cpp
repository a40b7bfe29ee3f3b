// One tint for the second band: nothing lost where the sky is grey, the best that one tint can do where it is not.
#include "lighting/environment/tinted_irradiance.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lighting/environment/cube.h"
#include "shading/shading.h"

namespace parity::lighting {
namespace {

namespace f64 = shading::f64;
using Coefficients = std::array<glm::vec3, 9>;

glm::dvec3 evaluate(const TintedIrradiance& tinted, const glm::dvec3& n) {
  f64::TintedSky sky;
  const auto vec = [](const glm::vec3& v) { return f64::real32x3(v.x, v.y, v.z); };
  for (int k = 0; k < 4; ++k) sky.c[k] = vec(tinted.linear[k]);
  sky.tint = vec(tinted.tint);
  for (int k = 0; k < 5; ++k) sky.q[k] = tinted.quadratic[k];
  const f64::real3 e = f64::tintedSkyDiffuse(sky, {n.x, n.y, n.z});
  return {e.x, e.y, e.z};
}

glm::dvec3 evaluateNine(const Coefficients& c, const glm::dvec3& n) {
  f64::IrradianceSh sh;
  for (int i = 0; i < 9; ++i) sh.c[i] = f64::real3(c[i].x, c[i].y, c[i].z);
  const f64::real3 e = f64::evalIrradianceSH(sh, {n.x, n.y, n.z});
  return glm::dvec3(e.x, e.y, e.z) / 3.14159265358979324;
}

template <typename Each> void forNormals(const Each& each) {
  constexpr int kNormals = 12;
  const std::vector<double> angles = texelSolidAngles(kNormals);
  for (int face = 0; face < kCubeFaces; ++face)
    for (int y = 0; y < kNormals; ++y)
      for (int x = 0; x < kNormals; ++x)
        each(texelDirection(face, x, y, kNormals), angles[static_cast<std::size_t>(y) * kNormals + x]);
}

// Every coefficient differs; the constant keeps all above 0.
Coefficients makeCoefficients(const glm::vec3& tint, const glm::vec3& other) {
  Coefficients c;
  c[0] = {40, 30, 50};
  for (int i = 1; i < 4; ++i) c[i] = glm::vec3(1, -2, 3) * (0.5f * static_cast<float>(i));
  for (int i = 4; i < 9; ++i)
    c[i] = tint * (3.f - static_cast<float>(i) * 0.7f) + other * std::cos(static_cast<float>(3 * i));
  return c;
}

TEST(TintedIrradiance, IsThatOfNineCoefficientsWhereTheSecondBandHasOneTint) {
  const Coefficients c = makeCoefficients({1, 0.5f, -0.25f}, glm::vec3(0));
  const TintedIrradiance tinted = tintIrradiance(c);
  forNormals([&](const glm::dvec3& n, double) {
    const glm::dvec3 a = evaluate(tinted, n), b = evaluateNine(c, n);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 1e-5);
  });
}

// The second singular value is what is lost: sigma2^2 + sigma3^2, from the eigenvalues of the 3x3 Gram matrix, by the
// characteristic polynomial.
TEST(TintedIrradiance, LosesNoMoreThanTheOtherSingularValues) {
  const Coefficients c = makeCoefficients({1, 0.5f, 0.25f}, {0.2f, -0.1f, 0.6f});
  const TintedIrradiance tinted = tintIrradiance(c);
  double lost = 0;
  forNormals([&](const glm::dvec3& n, double weight) {
    const glm::dvec3 d = evaluate(tinted, n) - evaluateNine(c, n);
    lost += weight * glm::dot(d, d);
  });
  glm::dmat3 gram(0.0);
  for (int i = 4; i < 9; ++i) {
    const glm::dvec3 v = glm::dvec3(c[i]) / 3.14159265358979324;
    gram += glm::outerProduct(v, v);
  }
  // The largest root of x^3 - t x^2 + m x - d, by Newton's method from above.
  const double t = gram[0][0] + gram[1][1] + gram[2][2], d = glm::determinant(gram);
  const glm::dmat3 square = gram * gram;
  const double m = 0.5 * (t * t - square[0][0] - square[1][1] - square[2][2]);
  double x = t;
  for (int i = 0; i < 60; ++i) x -= (((x - t) * x + m) * x - d) / ((3 * x - 2 * t) * x + m);
  ASSERT_GT(t - x, 0.01 * t) << "something is lost";
  EXPECT_NEAR(lost, t - x, 0.01 * (t - x));
}

TEST(TintedIrradiance, IsFiniteForBlackAndForTheBrightest) {
  EXPECT_EQ(evaluate(tintIrradiance({}), {0, 0, 1}), glm::dvec3(0));
  Coefficients bright = makeCoefficients(glm::vec3(1), glm::vec3(0));
  for (glm::vec3& each : bright) each *= 1e30f;
  const TintedIrradiance tinted = tintIrradiance(bright);
  for (const glm::vec3& each : tinted.linear) EXPECT_TRUE(std::isfinite(each.x + each.y + each.z));
  for (const float q : tinted.quadratic) EXPECT_TRUE(std::isfinite(q));
}

} // namespace
} // namespace parity::lighting
