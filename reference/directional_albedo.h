// The directional albedo of GGX without Fresnel, tabulated in double: what multiple scattering must make up for.
#pragma once

#include <array>
#include <vector>

#include "reference/surface_sample.h"

namespace parity::reference {

inline constexpr int kAlbedoNodes = 65; // along either axis

// E(mu) at one roughness.
class AlbedoRow {
public:
  AlbedoRow() { m_values.fill(1); } // of a mirror
  AlbedoRow(double alpha, const std::array<double, kAlbedoNodes>& values, double average)
      : m_alpha(alpha), m_average(average), m_values(values) {}

  // The integral of D V NoL over light directions: the share of light from a cosine mu in [0, 1] that leaves after one
  // scattering at F = 1. At most 1.
  double at(double mu) const;
  // 2 * integral of E mu dmu over [0, 1].
  double average() const { return m_average; }

private:
  double m_alpha = 0, m_average = 1;
  std::array<double, kAlbedoNodes> m_values{};
};

// E over roughness and mu: cubic interpolation (Lagrange, four points) in roughness and in
//   sqrt(mu (1 + alpha) / (mu + alpha)),
// where the grazing fall-off at mu ~ alpha looks alike for every roughness. Within 2e-5 of the integral for roughness
// in [0.05, 1] (tests/reference). Deterministic; made in about 0.2 s on 2 cores.
class DirectionalAlbedo {
public:
  explicit DirectionalAlbedo(GeometryTerm term);
  AlbedoRow row(double roughness) const;

private:
  std::vector<std::array<double, kAlbedoNodes>> m_rows; // m_rows[j]: roughness j / (kAlbedoNodes - 1)
  std::array<double, kAlbedoNodes> m_averages{};
};

} // namespace parity::reference
