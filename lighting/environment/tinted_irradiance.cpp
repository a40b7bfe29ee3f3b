// One tint for the second band (see tinted_irradiance.h).
#include "lighting/environment/tinted_irradiance.h"

#include <numbers>

#include "shading/shading.h"

namespace parity::lighting {

namespace {

using Coefficients = std::array<glm::dvec3, 9>;

// The direction in which the channels of the second band have most of their power: the largest eigenvector of their 3x3
// Gram matrix, by repeated squaring of the matrix. Unit, or 0 where the band is.
glm::dvec3 tintOf(const Coefficients& c) {
  glm::dmat3 gram(0.0);
  for (int i = 4; i < 9; ++i) gram += glm::outerProduct(c[i], c[i]);
  for (int turn = 0; turn < 12; ++turn) {
    const double trace = gram[0][0] + gram[1][1] + gram[2][2];
    if (!(trace > 0)) return glm::dvec3(0.0);
    gram = (gram / trace) * (gram / trace);
  }
  int longest = 0;
  for (int i = 1; i < 3; ++i)
    if (glm::dot(gram[i], gram[i]) > glm::dot(gram[longest], gram[longest])) longest = i;
  return glm::normalize(gram[longest]);
}

} // namespace

TintedIrradiance tintIrradiance(const std::array<glm::vec3, 9>& irradianceSh) {
  Coefficients c;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = glm::dvec3(irradianceSh[i]) / std::numbers::pi;
  const glm::dvec3 tint = tintOf(c);
  std::array<double, 9> q{};
  for (int i = 4; i < 9; ++i) q[i] = glm::dot(c[i], tint);
  // k (3 z^2 - 1) with z^2 = 1 - x^2 - y^2 is 2 k - 3 k x^2 - 3 k y^2.
  const shading::f64::ShBasis alongX = shading::f64::shBasis({1, 0, 0}), alongY = shading::f64::shBasis({0, 1, 0}),
                              alongZ = shading::f64::shBasis({0, 0, 1});
  const double k6 = 0.5 * alongZ.y[6], k8 = alongX.y[8],
               kMixed = 2 * k8; // xy, yz and zx have twice the factor of x^2 - y^2
  TintedIrradiance tinted;
  tinted.linear[0] = glm::vec3(c[0] * alongX.y[0] + tint * (2 * k6 * q[6]));
  tinted.linear[1] = glm::vec3(c[3] * alongX.y[3]);
  tinted.linear[2] = glm::vec3(c[1] * alongY.y[1]);
  tinted.linear[3] = glm::vec3(c[2] * alongZ.y[2]);
  tinted.tint = glm::vec3(tint);
  tinted.quadratic = {static_cast<float>(k8 * q[8] - 3 * k6 * q[6]), static_cast<float>(kMixed * q[4]),
                      static_cast<float>(kMixed * q[7]), static_cast<float>(-k8 * q[8] - 3 * k6 * q[6]),
                      static_cast<float>(kMixed * q[5])};
  return tinted;
}

} // namespace parity::lighting
