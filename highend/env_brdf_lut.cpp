// The environment BRDF by quadrature that converges: exact bounds of the domain instead of samples that miss it.
//
// A and B are the integrals over L of D V NoL (1 - F) and D V NoL F, F = (1 - VoH)^5 (Karis 2013, eq. 8). Over half
// vectors (theta, phi) around N, dL = 4 VoH dH; with xi = the share of the GGX lobe within theta, tan^2 theta =
// alpha^2 xi / (1 - xi) (Walter et al. 2007, eq. 35), they are
//   1/pi int dxi int_0^phiMax dphi 4 V NoL VoH / cos theta (1 - F | F)
// L stands above the horizon where cos phi > -cot(2 theta) cot(thetaV). So up to theta1 = (pi/2 - thetaV) / 2 the
// circle is whole, from there to theta2 = (pi/2 + thetaV) / 2 a part: in each of the two the integrand is smooth.
#include "highend/env_brdf_lut.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shading/shading.h"

namespace parity::highend {

namespace {

using namespace shading::f64;

using std::numbers::pi;
// With 16 x 8 nodes in each part a texel is within 1e-4 (rms 2e-5) of 200 x 200; with 12 x 8, within 8e-4 (1e-4).
constexpr int kThetaNodes = 16, kPhiNodes = 8;
// Stand for 0 and, along the normal, for 1, where the integrand is 0/0.
constexpr double kLeastNoV = 1e-4, kMostNoV = 1 - 1e-8, kLeastRoughness = 1e-3;

// Gauss-Legendre on [0, 1].
template <int count> struct Nodes { std::array<double, count> x{}, weight{}; };

template <int count> Nodes<count> makeNodes() {
  Nodes<count> nodes;
  for (int i = 0; i < count; ++i) {
    // A root of Legendre's polynomial by Newton's method from Tricomi's estimate.
    double x = std::cos(pi * (i + 0.75) / (count + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double previous = 1, value = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
        previous = value;
        value = next;
      }
      slope = count * (x * value - previous) / (x * x - 1);
      x -= value / slope;
    }
    nodes.x[i] = 0.5 + 0.5 * x;
    nodes.weight[i] = 1 / ((1 - x * x) * slope * slope);
  }
  return nodes;
}

struct Rule {
  Nodes<kThetaNodes> theta = makeNodes<kThetaNodes>();
  Nodes<kPhiNodes> phi = makeNodes<kPhiNodes>();
  std::array<double, kPhiNodes> circleCos{}; // of midpoints on [0, pi], which is exact for a smooth periodic function
  Rule() {
    for (int i = 0; i < kPhiNodes; ++i) circleCos[i] = std::cos(pi * (i + 0.5) / kPhiNodes);
  }
};

template <FresnelCurve curve> double fresnelWeight(double VoH) {
  if constexpr (curve == FresnelCurve::sphericalGaussian) return sphericalGaussianWeight(VoH);
  if constexpr (curve == FresnelCurve::dielectric) return dielectricWeight(VoH);
  return schlickWeight(VoH);
}

template <GeometryTerm term, FresnelCurve curve> real2 integrate(double NoV, double roughness, const Rule& rule) {
  const double alpha = roughness * roughness, a2 = alpha * alpha, sinV = std::sqrt(1 - NoV * NoV);
  const auto shareWithin = [a2](double cos2) { return (1 - cos2) / (1 - cos2 * (1 - a2)); };
  const auto cos2Of = [a2](double xi) { return (1 - xi) / (1 - (1 - a2) * xi); };

  double sumA = 0, sumB = 0;
  const auto add = [&](double weight, double cosTheta, double sinTheta, double cosPhi) {
    const double VoH = NoV * cosTheta + sinV * sinTheta * cosPhi, NoL = 2 * VoH * cosTheta - NoV;
    if (NoL <= 0) return; // by rounding, at the very border
    const double V =
        term == GeometryTerm::schlickSmith ? V_SchlickSmith(alpha, NoV, NoL) : V_SmithGGXCorrelated(alpha, NoV, NoL);
    const double value = weight * 4 * V * NoL * VoH / cosTheta;
    const double F = fresnelWeight<curve>(VoH);
    sumA += value * (1 - F);
    sumB += value * F;
  };

  const double xi1 = shareWithin((1 + sinV) / 2);
  for (int i = 0; i < kThetaNodes; ++i) {
    const double cos2 = cos2Of(xi1 * rule.theta.x[i]), cosTheta = std::sqrt(cos2), sinTheta = std::sqrt(1 - cos2);
    for (int j = 0; j < kPhiNodes; ++j)
      add(xi1 * rule.theta.weight[i] / kPhiNodes, cosTheta, sinTheta, rule.circleCos[j]);
  }

  // Here xi = sin^2 psi, as the integrand holds square roots of xi and 1 - xi; and psi crowds at both ends, where
  // phiMax has roots of its own.
  const double psi1 = std::asin(std::sqrt(xi1)), psi2 = std::asin(std::sqrt(shareWithin((1 - sinV) / 2)));
  for (int i = 0; i < kThetaNodes; ++i) {
    const double t = rule.theta.x[i], psi = psi1 + (psi2 - psi1) * t * t * (3 - 2 * t), sinPsi = std::sin(psi);
    const double dxi = rule.theta.weight[i] * (psi2 - psi1) * 6 * t * (1 - t) * 2 * sinPsi * std::cos(psi);
    const double cos2 = cos2Of(sinPsi * sinPsi), cosTheta = std::sqrt(cos2), sinTheta = std::sqrt(1 - cos2);
    const double cot2Theta = (2 * cos2 - 1) / (2 * sinTheta * cosTheta);
    const double phiMax = std::acos(std::clamp(-cot2Theta * NoV / sinV, -1.0, 1.0));
    for (int j = 0; j < kPhiNodes; ++j)
      add(dxi * rule.phi.weight[j] * phiMax / pi, cosTheta, sinTheta, std::cos(phiMax * rule.phi.x[j]));
  }
  return {sumA, sumB};
}

using Integrate = real2 (*)(double NoV, double roughness, const Rule& rule);

template <GeometryTerm term> Integrate chooseIntegral(FresnelCurve curve) {
  if (curve == FresnelCurve::sphericalGaussian) return integrate<term, FresnelCurve::sphericalGaussian>;
  if (curve == FresnelCurve::dielectric) return integrate<term, FresnelCurve::dielectric>;
  return integrate<term, FresnelCurve::schlick>;
}

} // namespace

base::Image makeEnvBrdfLut(GeometryTerm term, FresnelCurve fresnel, int size) {
  assert(size >= 2 && size <= base::kMaxImageSide);
  base::Image lut(size, size, 4);
  const Rule rule;
  const Integrate integrateTexel = term == GeometryTerm::schlickSmith
                                       ? chooseIntegral<GeometryTerm::schlickSmith>(fresnel)
                                       : chooseIntegral<GeometryTerm::heightCorrelated>(fresnel);
  base::parallelFor(size, 1, [&](std::size_t row, std::size_t) {
    const int y = static_cast<int>(row);
    double average = 0;
    const double roughness = std::max(y / (size - 1.0), kLeastRoughness);
    for (int x = 0; x < size; ++x) {
      const double NoV = x / (size - 1.0), weight = x == 0 || x == size - 1 ? 0.5 : 1;
      const real2 ab = integrateTexel(std::clamp(NoV, kLeastNoV, kMostNoV), roughness, rule);
      lut.at(x, y)[0] = static_cast<float>(ab.x);
      lut.at(x, y)[1] = static_cast<float>(ab.y);
      average += weight * 2 * NoV * (ab.x + ab.y) / (size - 1);
    }
    for (int x = 0; x < size; ++x) {
      lut.at(x, y)[2] = static_cast<float>(average);
      lut.at(x, y)[3] = 1;
    }
  });
  return lut;
}

} // namespace parity::highend
