// Numerical integration for the truths of the shading tests (see quadrature.h).
#include "shading/quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::tests {
namespace {
using std::numbers::pi;
}

GaussRule::GaussRule(int n) : nodes(n), weights(n) {
  for (int i = 0; i < n; ++i) { // Newton on the Legendre polynomial from Chebyshev's guess
    double x = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p0 = 1, p1 = x;
      for (int k = 2; k <= n; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1);
      const double step = p1 / slope;
      x -= step;
      if (std::fabs(step) < 1e-16) break;
    }
    nodes[i] = x;
    weights[i] = 2 / ((1 - x * x) * slope * slope);
  }
}

PanelRule::PanelRule(const std::vector<double>& edges, int n) {
  const GaussRule rule(n);
  for (std::size_t panel = 0; panel + 1 < edges.size(); ++panel) {
    const double half = (edges[panel + 1] - edges[panel]) / 2, middle = (edges[panel + 1] + edges[panel]) / 2;
    for (int i = 0; i < n; ++i) {
      nodes.push_back(middle + half * rule.nodes[i]);
      weights.push_back(half * rule.weights[i]);
    }
  }
}

double integrateLobe(double alpha, double NoV, int order, const std::function<double(const Cosines&)>& f) {
  // Panels gather where the integrand turns: phi = pi/2 at grazing views, psi = pi/2 in the far tail of a sharp lobe.
  static const std::vector<double> phiEdges = {0.0, 0.7, 1.2, 1.45, 1.54, pi / 2, 1.6, 1.69, 1.94, 2.44, pi};
  static const std::vector<double> psiEdges = {0.0, 0.4, 0.7, 0.85, 0.95, 0.985, 1.0};
  const PanelRule phis(phiEdges, order), psis(psiEdges, order);
  const double sinV = std::sqrt(std::max(0.0, 1 - NoV * NoV));
  double sum = 0;
  for (std::size_t p = 0; p < phis.nodes.size(); ++p) {
    const double side = sinV * std::cos(phis.nodes[p]);
    // NoL = M cos(2 theta - delta): the light sets where 2 theta = delta + pi/2.
    const double thetaMax = (pi / 2 + std::atan2(side, NoV)) / 2;
    const double psiMax = std::atan2(std::sin(thetaMax), alpha * std::cos(thetaMax));
    double inner = 0;
    for (std::size_t s = 0; s < psis.nodes.size(); ++s) {
      const double psi = psiMax * psis.nodes[s];
      const double sinPsi = std::sin(psi), cosPsi = std::cos(psi);
      const double scale = 1 / std::hypot(alpha * sinPsi, cosPsi);
      const double NoH = cosPsi * scale, sinH = alpha * sinPsi * scale;
      const double VoH = sinH * side + NoH * NoV;
      const double NoL = 2 * VoH * NoH - NoV;
      if (NoL <= 0 || VoH <= 0) continue;              // rounding at the very edge
      const double thetaSlope = alpha * scale * scale; // d theta / d psi
      inner += psis.weights[s] * psiMax * thetaSlope * sinH * 4 * VoH * f({NoL, NoH, VoH});
    }
    sum += phis.weights[p] * inner;
  }
  return 2 * sum; // phi and -phi
}

double integrateAroundReflection(double c, double NoV, int order,
                                 const std::function<double(double NoL, double RoL)>& f) {
  static const std::vector<double> edges = {0.0, 0.02, 0.1, 0.3, 0.6, 0.85, 0.97, 1.0};
  const PanelRule lobe(edges, order), around({0.0, 0.25, 0.5, 0.75, 1.0}, order);
  const double sinR = std::sqrt(std::max(0.0, 1 - NoV * NoV));
  const double least = std::exp2(-2 * c);
  double sum = 0;
  for (std::size_t i = 0; i < lobe.nodes.size(); ++i) {
    // u = 2^(c (RoL - 1)) runs evenly from `least` (RoL = -1) to 1, so dRoL = du / (u c ln 2).
    const double u = least + (1 - least) * lobe.nodes[i];
    const double RoL = std::clamp(1 + std::log2(u) / c, -1.0, 1.0);
    const double sinL = std::sqrt(1 - RoL * RoL);
    // NoL = RoL NoV + sinL sinR cos(psi) > 0
    const double edge = sinL * sinR > 0 ? std::clamp(-RoL * NoV / (sinL * sinR), -1.0, 1.0) : (RoL > 0 ? -1.0 : 1.0);
    const double psiMax = std::acos(edge);
    double inner = 0;
    for (std::size_t k = 0; k < around.nodes.size(); ++k) {
      const double NoL = RoL * NoV + sinL * sinR * std::cos(psiMax * around.nodes[k]);
      if (NoL > 0) inner += around.weights[k] * psiMax * f(NoL, RoL);
    }
    sum += lobe.weights[i] * (1 - least) * 2 * inner / (u * c * std::numbers::ln2);
  }
  return sum;
}

double distribution(double alpha, double NoH) {
  const double b = NoH * NoH * (alpha * alpha - 1) + 1;
  return alpha * alpha / (pi * b * b);
}

double maskingShadowing(Geometry geometry, double alpha, double NoV, double NoL) {
  if (geometry == Geometry::schlickSmith) {
    const double k = alpha / 2;
    return NoV / (NoV * (1 - k) + k) * (NoL / (NoL * (1 - k) + k));
  }
  // Heitz 2014: Lambda = (-1 + sqrt(1 + alpha^2 tan^2)) / 2, G2 = 1 / (1 + Lambda(v) + Lambda(l)).
  const auto lambda = [alpha](double cosine) {
    return (-1 + std::sqrt(1 + alpha * alpha * (1 - cosine * cosine) / (cosine * cosine))) / 2;
  };
  return 1 / (1 + lambda(NoV) + lambda(NoL));
}

EnvBrdf integrateEnvBrdf(Geometry geometry, double roughness, double NoV, int order) {
  const double alpha = roughness * roughness;
  const auto reflect = [&](const Cosines& c, double fresnel) { // f cos = D G2 F / (4 NoV)
    return distribution(alpha, c.NoH) * maskingShadowing(geometry, alpha, NoV, c.NoL) * fresnel / (4 * NoV);
  };
  const auto schlick = [](const Cosines& c) { return std::pow(1 - c.VoH, 5); };
  EnvBrdf e;
  e.A = integrateLobe(alpha, NoV, order, [&](const Cosines& c) { return reflect(c, 1 - schlick(c)); });
  e.B = integrateLobe(alpha, NoV, order, [&](const Cosines& c) { return reflect(c, schlick(c)); });
  return e;
}

} // namespace parity::tests
