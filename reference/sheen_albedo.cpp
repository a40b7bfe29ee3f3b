// The integral runs over the light's cosine and azimuth. Masking and shadowing depend on the cosine alone, D on both.
// Panels of the cosine widen geometrically from NoV on, where shadowing turns; those of the azimuth narrow towards the
// mirror direction, where the half vector passes the normal and D is 0.
#include "reference/sheen_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "reference/interpolation.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

namespace f64 = shading::f64;
using std::numbers::pi;

constexpr int kRoughnessNodes = 33, kViewNodes = 41;
constexpr double kLeastSheenRoughness = 0.07, kLeastNoV = 1e-4;

// Nodes are even in the logarithm of the roughness, as D's width goes with it, and in the fourth root of NoV.
double roughnessOfNode(double node) { return std::pow(kLeastSheenRoughness, 1 - node / (kRoughnessNodes - 1)); }
double nodeOfRoughness(double roughness) {
  return (1 - std::log(std::clamp(roughness, kLeastSheenRoughness, 1.0)) / std::log(kLeastSheenRoughness)) *
         (kRoughnessNodes - 1);
}
constexpr double kLeastRoot = 0.1; // of kLeastNoV
double viewOfNode(double node) {
  const double q = kLeastRoot + (1 - kLeastRoot) * node / (kViewNodes - 1);
  return std::min(q * q * q * q, 1.0);
}
double nodeOfView(double NoV) {
  return (std::pow(std::clamp(NoV, kLeastNoV, 1.0), 0.25) - kLeastRoot) / (1 - kLeastRoot) * (kViewNodes - 1);
}

// The cosine and the weight of each azimuth of [0, pi]; weights sum to 2 pi, both sides.
QuadratureRule makeSheenAzimuths() {
  constexpr int kPanels = 4;
  const QuadratureRule gauss = makeGaussRule(8);
  QuadratureRule rule;
  double width = pi;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double next = panel + 1 < kPanels ? width / 4 : 0;
    for (std::size_t i = 0; i < gauss.x.size(); ++i) {
      rule.x.push_back(std::cos(pi - width + (width - next) * gauss.x[i]));
      rule.weight.push_back(2 * (width - next) * gauss.weight[i]);
    }
    width = next;
  }
  return rule;
}

double integrateSheen(double alpha, double NoV, const QuadratureRule& azimuths, const QuadratureRule& gauss) {
  constexpr double kNegligible = 1e-9;
  const double sinV = std::sqrt((1 - NoV) * (1 + NoV));
  double sum = 0;
  for (double low = 0, high = std::min(NoV, 0.25); low < 1; low = high, high = high < 0.25 ? 4 * high : 1)
    for (std::size_t i = 0; i < gauss.x.size(); ++i) {
      const double top = std::min(high, 1.0), NoL = low + (top - low) * gauss.x[i];
      const double sinL = std::sqrt((1 - NoL) * (1 + NoL)), across = NoV + NoL;
      const auto distributionAt = [&](double cosPhi) {
        const double NoH2 = across * across / (2 + 2 * (sinV * sinL * cosPhi + NoV * NoL));
        return f64::D_Charlie(alpha, std::sqrt(std::min(NoH2, 1.0)));
      };
      if (distributionAt(1) < kNegligible) continue; // the greatest
      double around = 0;
      for (std::size_t a = 0; a < azimuths.x.size(); ++a) around += azimuths.weight[a] * distributionAt(azimuths.x[a]);
      sum += (top - low) * gauss.weight[i] * f64::V_Charlie(alpha, NoV, NoL) * NoL * around;
    }
  return sum;
}

} // namespace

SheenAlbedo::SheenAlbedo() : m_nodes(kRoughnessNodes * kViewNodes) {
  const QuadratureRule azimuths = makeSheenAzimuths(), gauss = makeGaussRule(8);
  base::parallelFor(kRoughnessNodes, 1, [&](std::size_t j, std::size_t) {
    const double alpha = f64::sheenAlpha(roughnessOfNode(static_cast<double>(j)));
    for (int i = 0; i < kViewNodes; ++i)
      m_nodes[j * kViewNodes + static_cast<std::size_t>(i)] = integrateSheen(alpha, viewOfNode(i), azimuths, gauss);
  });
}

double SheenAlbedo::at(double sheenRoughness, double NoV) const {
  const Stencil row = makeStencil(nodeOfRoughness(sheenRoughness), kRoughnessNodes);
  const Stencil column = makeStencil(nodeOfView(NoV), kViewNodes);
  double value = 0;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      value += row.weight[static_cast<std::size_t>(j)] * column.weight[static_cast<std::size_t>(i)] *
               m_nodes[static_cast<std::size_t>((row.first + j) * kViewNodes + column.first + i)];
  return std::max(value, 0.0);
}

double SheenAlbedo::shareAt(double sheenRoughness, double NoV) const { return std::min(at(sheenRoughness, NoV), 1.0); }

} // namespace parity::reference
