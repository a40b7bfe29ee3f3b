#include "bake/light/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::bake {

namespace {

// Share of the cosine in the density.
constexpr double kCosineShare = 0.75;
// Added to the sine of the widest angle: what is in sight of a point by rounding alone is not lost.
constexpr double kSineSlack = 1e-5;

} // namespace

Directions::Directions(std::span<const glm::vec3> normals, bool bothSides) : m_bothSides(bothSides) {
  glm::dvec3 sum(0);
  for (const glm::vec3& n : normals) sum += glm::dvec3(n);
  m_axis = glm::dot(sum, sum) > 1e-12 ? glm::normalize(sum) : glm::dvec3(normals[0]);
  double least = 1; // cosine between the axis and a normal
  for (const glm::vec3& n : normals) least = std::min(least, glm::dot(glm::dvec3(n), m_axis));
  if (!bothSides && least < 1 - kSineSlack * kSineSlack)
    m_below = least > 0 ? std::min(std::sqrt(1 - least * least) + kSineSlack, 1.0) : 1;
  m_even = (1 - kCosineShare) / (1 + m_below);
  // A frame about the axis: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
  const glm::dvec3& n = m_axis;
  const double s = std::copysign(1.0, n.z), a = -1 / (s + n.z), b = n.x * n.y * a;
  m_x = glm::dvec3(1 + s * n.x * n.x * a, s * b, -s * n.x);
  m_y = glm::dvec3(b, s + n.y * n.y * a, -n.y);
}

// The density of the cosine c is m_even + 2 kCosineShare max(c, 0).
glm::dvec3 Directions::at(glm::dvec2 u) const {
  bool behind = false;
  if (m_bothSides) {
    behind = u.x >= 0.5;
    u.x = behind ? 2 * u.x - 1 : 2 * u.x;
  }
  constexpr double a = kCosineShare;
  const double b = m_even, rest = u.x - b * m_below;
  double c = rest < 0 ? rest / b : (std::sqrt(b * b + 4 * a * rest) - b) / (2 * a);
  c = std::clamp(c, -m_below, 1.0);
  const double s = std::sqrt(std::max(1 - c * c, 0.0)), phi = 2 * std::numbers::pi * u.y;
  return s * std::cos(phi) * m_x + s * std::sin(phi) * m_y + (behind ? -c : c) * m_axis;
}

double Directions::pdf(const glm::dvec3& direction) const {
  const double c = glm::dot(m_axis, direction);
  if (!m_bothSides && c < -m_below) return 0;
  const double cosine = m_bothSides ? std::abs(c) : std::max(c, 0.0);
  return (m_even + 2 * kCosineShare * cosine) * (m_bothSides ? 0.25 : 0.5) * std::numbers::inv_pi;
}

} // namespace parity::bake
