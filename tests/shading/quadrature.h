// Numerical integration for the truths that the formulas are tested against: Gauss-Legendre, the half-vector domain of
// a microfacet lobe, and directional albedos. Everything in double.
#pragma once

#include <functional>
#include <vector>

namespace parity::tests {

// Nodes and weights of the n-point Gauss-Legendre rule on [-1, 1].
struct GaussRule {
  explicit GaussRule(int n);
  std::vector<double> nodes, weights;
};

// Nodes and weights over consecutive panels [edges[i], edges[i+1]], n points each.
struct PanelRule {
  PanelRule(const std::vector<double>& edges, int n);
  std::vector<double> nodes, weights;
};

// The cosines at one pair of half vector and view.
struct Cosines {
  double NoL, NoH, VoH;
};

// The integral of f(l) over the hemisphere of lights NoL > 0 at a view of cosine NoV > 0, where f is concentrated like
// the GGX lobe of `alpha` > 0. Integrates over half vectors h with tan(theta_h) = alpha tan(psi), dl = 4 VoH dh; the
// bound on theta_h where the light sets (NoL = 0) is in closed form, so the integrand is smooth.
// order: points a panel; 12 gives 1e-6 or better for alpha >= 1e-3 and NoV >= 0.03.
double integrateLobe(double alpha, double NoV, int order, const std::function<double(const Cosines&)>& f);

enum class Geometry { schlickSmith, heightCorrelated };

// The integral of a function of Cosines' NoL and RoL = l.r over the hemisphere, for a lobe around the mirror direction
// r of the view that falls off like 2^(c (RoL - 1)), c > 0.
double integrateAroundReflection(double c, double NoV, int order,
                                 const std::function<double(double NoL, double RoL)>& f);

// A and B of the microfacet model in textbook form (D, G1, G2 written out here, not shading/): F0 A + B is the
// directional albedo. docs/shading.md 1's two truths.
struct EnvBrdf {
  double A, B;
};
EnvBrdf integrateEnvBrdf(Geometry geometry, double roughness, double NoV, int order = 12);

// Textbook G2 of each geometry term.
double maskingShadowing(Geometry geometry, double alpha, double NoV, double NoL);
// Textbook GGX.
double distribution(double alpha, double NoH);

} // namespace parity::tests
