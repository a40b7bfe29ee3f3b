// The directional albedo of GGX, tabulated in double: what multiple scattering must make up for, and what specular
// light leaves to the diffuse lobe.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "lighting/environment/float4.h"
#include "shading/surface_model.h"

namespace parity::reference {

using shading::FresnelCurve;
using shading::GeometryTerm;

inline constexpr int kAlbedoNodes = 65; // along either axis

using AlbedoNodes = std::array<double, kAlbedoNodes>;

// E(mu) at one roughness.
class AlbedoRow {
public:
  AlbedoRow(double alpha, const AlbedoNodes& values, const AlbedoNodes& fresnelWeights, double average)
      : m_alpha(alpha), m_average(average), m_values(values), m_fresnelWeights(fresnelWeights) {}

  // The integral of D V NoL over light directions: the share of light from a cosine mu in [0, 1] that leaves after one
  // scattering at F = 1. At most 1.
  double at(double mu) const;
  // About the same of four, linear between nodes: within 1e-3.
  lighting::Float4 near(const lighting::Float4& mu) const;
  // The mean of Fresnel's weight f(VoH) over those directions: at F = F0 (1 - f) + F90 f the share is E (F0 + (F90 -
  // F0) times it).
  double fresnelWeightAt(double mu) const;
  // 2 * integral of E mu dmu over [0, 1].
  double average() const { return m_average; }

private:
  double m_alpha, m_average;
  AlbedoNodes m_values, m_fresnelWeights;
};

// E over roughness and mu: cubic interpolation (Lagrange, four points) in roughness and in
//   sqrt(mu (1 + alpha) / (mu + alpha)),
// where the grazing fall-off at mu ~ alpha looks alike for every roughness; Fresnel's weight, which has no such
// fall-off, in sqrt(mu). Within 2.5e-5 of the integral for roughness in [0.05, 1] (tests/reference). Deterministic;
// made in about 0.4 s on 2 cores.
class DirectionalAlbedo {
public:
  explicit DirectionalAlbedo(GeometryTerm term, FresnelCurve fresnel = FresnelCurve::schlick);
  AlbedoRow row(double roughness) const;

  // All of the table, to be kept; fromBytes gives nothing where the bytes are not of such a table.
  std::vector<std::byte> toBytes() const;
  static std::optional<DirectionalAlbedo> fromBytes(std::span<const std::byte> bytes);

private:
  DirectionalAlbedo() = default;

  std::vector<AlbedoNodes> m_rows, m_fresnelWeights; // [j]: roughness j / (kAlbedoNodes - 1)
  AlbedoNodes m_averages{};
};

} // namespace parity::reference
