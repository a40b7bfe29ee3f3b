// The integral runs over half vectors distributed as D NoH (Walter et al. 2007, eq. 35), which leaves V 4 NoL VoH / NoH
// (Karis 2013); for each azimuth the polar angle ends in closed form where the light sets, so the integrand is smooth.
// Near grazing that end jumps where the azimuth passes a right angle: panels narrow geometrically towards it.
#include "reference/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/parallel.h"
#include "reference/fresnel.h"
#include "reference/interpolation.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

namespace f64 = shading::f64;
using std::numbers::pi;
// Row 0 stands for the limit of small roughness at fixed mu / alpha.
constexpr double kLeastRoughness = 1e-3;

// [0, pi], divided at pi/2 -+ pi/2 4^-k; weights sum to 1.
QuadratureRule makeAzimuths() {
  constexpr int kPanels = 8;
  const QuadratureRule gauss = makeGaussRule(8);
  QuadratureRule rule;
  double width = pi / 2;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double next = panel + 1 < kPanels ? width / 4 : 0;
    for (std::size_t i = 0; i < gauss.x.size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        rule.x.push_back(pi / 2 + side * (next + (width - next) * gauss.x[i]));
        rule.weight.push_back(gauss.weight[i] * (width - next) / pi);
      }
    width = next;
  }
  return rule;
}

// [0, 1], divided at 1 - 4^-k: towards the end a smooth lobe's tail is squeezed together.
QuadratureRule makePolar() {
  constexpr int kPanels = 5;
  const QuadratureRule gauss = makeGaussRule(10);
  QuadratureRule rule;
  double width = 1;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double next = panel + 1 < kPanels ? width / 4 : 0;
    for (std::size_t i = 0; i < gauss.x.size(); ++i) {
      rule.x.push_back(1 - width + (width - next) * gauss.x[i]);
      rule.weight.push_back(gauss.weight[i] * (width - next));
    }
    width = next;
  }
  return rule;
}

struct Albedo {
  double E = 0, fresnelWeight = 0; // fresnelWeight: its mean
};

Albedo integrate(GeometryTerm term, FresnelCurve fresnel, double alpha, double NoV, const QuadratureRule& azimuths,
                 const QuadratureRule& polar) {
  const double a2 = alpha * alpha, sinV = std::sqrt(std::max(0.0, 1 - NoV * NoV));
  Albedo sum;
  for (std::size_t a = 0; a < azimuths.x.size(); ++a) {
    const double cosPhi = std::cos(azimuths.x[a]);
    // NoL = sinV cosPhi sin 2t + NoV cos 2t is positive up to 2t = atan2(sinV cosPhi, NoV) + pi/2.
    const double limit = 0.5 * (std::atan2(sinV * cosPhi, NoV) + pi / 2), s = std::sin(limit);
    // tan t = alpha tan psi: the share of D NoH within psi is sin^2 psi.
    const double psiLimit = std::atan2(s, alpha * std::cos(limit));
    for (std::size_t i = 0; i < polar.x.size(); ++i) {
      const double psi = psiLimit * polar.x[i], sinPsi = std::sin(psi), cosPsi = std::cos(psi);
      const double length = std::sqrt(cosPsi * cosPsi + a2 * sinPsi * sinPsi);
      const double NoH = cosPsi / length, sinH = alpha * sinPsi / length;
      const double VoH = sinV * sinH * cosPhi + NoV * NoH, NoL = 2 * VoH * NoH - NoV;
      if (NoL <= 0 || VoH <= 0) continue; // a rounding beyond the limit
      const double V = term == GeometryTerm::heightCorrelated ? f64::V_SmithGGXCorrelated(alpha, NoV, NoL)
                                                              : f64::V_SchlickSmith(alpha, NoV, NoL);
      const double share =
          azimuths.weight[a] * polar.weight[i] * psiLimit * 2 * sinPsi * cosPsi * V * 4 * NoL * VoH / NoH;
      sum.E += share;
      sum.fresnelWeight += share * fresnelWeight(fresnel, VoH);
    }
  }
  return {std::min(sum.E, 1.0), sum.fresnelWeight / sum.E};
}

double read(const AlbedoNodes& nodes, double q) {
  const Stencil stencil = makeStencil(q * (kAlbedoNodes - 1), kAlbedoNodes);
  double value = 0;
  for (int k = 0; k < 4; ++k) value += stencil.weight[k] * nodes[stencil.first + k];
  return value;
}

double muOfNode(int node, double alpha) {
  const double q = node / (kAlbedoNodes - 1.0), s = q * q;
  return s * alpha / (1 + alpha - s);
}

} // namespace

double AlbedoRow::at(double mu) const {
  const double s = mu * (1 + m_alpha) / (mu + m_alpha);
  return std::min(read(m_values, std::sqrt(std::clamp(s, 0.0, 1.0))), 1.0);
}

lighting::Float4 AlbedoRow::near(const lighting::Float4& mu) const {
  const auto alpha = static_cast<float>(m_alpha);
  const lighting::Float4 q = lighting::squareRoot(mu * (1 + alpha) / (mu + alpha)) * (kAlbedoNodes - 1.f);
  lighting::Float4 values{};
  for (int i = 0; i < 4; ++i) {
    const auto node = static_cast<std::size_t>(std::clamp(static_cast<int>(q[i]), 0, kAlbedoNodes - 2));
    values[i] =
        static_cast<float>(m_values[node] + (q[i] - static_cast<float>(node)) * (m_values[node + 1] - m_values[node]));
  }
  return values;
}

double AlbedoRow::fresnelWeightAt(double mu) const {
  return std::clamp(read(m_fresnelWeights, std::sqrt(std::clamp(mu, 0.0, 1.0))), 0.0, 1.0);
}

DirectionalAlbedo::DirectionalAlbedo(GeometryTerm term, FresnelCurve fresnel)
    : m_rows(kAlbedoNodes), m_fresnelWeights(kAlbedoNodes) {
  const QuadratureRule azimuths = makeAzimuths(), polar = makePolar(), gauss = makeGaussRule(128);
  base::parallelFor(kAlbedoNodes, 1, [&](std::size_t j, std::size_t) {
    const double roughness = std::max(static_cast<double>(j) / (kAlbedoNodes - 1), kLeastRoughness);
    const double alpha = roughness * roughness, leastMu = 1e-9 * alpha;
    for (int i = 0; i < kAlbedoNodes; ++i) {
      const double q = i / (kAlbedoNodes - 1.0);
      m_rows[j][i] = integrate(term, fresnel, alpha, std::max(muOfNode(i, alpha), leastMu), azimuths, polar).E;
      m_fresnelWeights[j][i] = integrate(term, fresnel, alpha, std::max(q * q, leastMu), azimuths, polar).fresnelWeight;
    }
    // In s, where the row is a smooth curve: dmu/ds = alpha (1 + alpha) / (1 + alpha - s)^2.
    const AlbedoRow row(alpha, m_rows[j], m_fresnelWeights[j], 1);
    double lost = 0;
    for (std::size_t k = 0; k < gauss.x.size(); ++k) {
      const double s = gauss.x[k], rest = 1 + alpha - s, mu = s * alpha / rest;
      lost += gauss.weight[k] * 2 * mu * (1 - row.at(mu)) * alpha * (1 + alpha) / (rest * rest);
    }
    m_averages[j] = 1 - lost;
  });
}

std::vector<std::byte> DirectionalAlbedo::toBytes() const {
  std::vector<std::byte> bytes;
  const auto add = [&](const AlbedoNodes& nodes) {
    const auto part = std::as_bytes(std::span(nodes));
    bytes.insert(bytes.end(), part.begin(), part.end());
  };
  for (const auto* rows : {&m_rows, &m_fresnelWeights}) std::ranges::for_each(*rows, add);
  add(m_averages);
  return bytes;
}

std::optional<DirectionalAlbedo> DirectionalAlbedo::fromBytes(std::span<const std::byte> bytes) {
  if (bytes.size() != (2 * kAlbedoNodes + 1) * sizeof(AlbedoNodes)) return std::nullopt;
  DirectionalAlbedo table;
  const auto take = [&](AlbedoNodes& nodes) {
    std::memcpy(nodes.data(), bytes.data(), sizeof nodes);
    bytes = bytes.subspan(sizeof nodes);
  };
  for (auto* rows : {&table.m_rows, &table.m_fresnelWeights}) {
    rows->resize(kAlbedoNodes);
    std::ranges::for_each(*rows, take);
  }
  take(table.m_averages);
  return table;
}

AlbedoRow DirectionalAlbedo::row(double roughness) const {
  const Stencil stencil = makeStencil(std::clamp(roughness, 0.0, 1.0) * (kAlbedoNodes - 1), kAlbedoNodes);
  AlbedoNodes values{}, fresnelWeights{};
  double average = 0;
  for (int k = 0; k < 4; ++k) {
    const int j = stencil.first + k;
    for (int i = 0; i < kAlbedoNodes; ++i) {
      values[i] += stencil.weight[k] * m_rows[j][i];
      fresnelWeights[i] += stencil.weight[k] * m_fresnelWeights[j][i];
    }
    average += stencil.weight[k] * m_averages[j];
  }
  const double alpha = std::max(roughness * roughness, kLeastRoughness * kLeastRoughness);
  return {alpha, values, fresnelWeights, std::min(average, 1.0)};
}

} // namespace parity::reference
