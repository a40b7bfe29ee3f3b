#include "reference/point_visibility.h"

#include <cmath>

namespace parity::reference {

PointVisibility::PointVisibility(const lighting::Visibility* visibility, const SurfaceSample& sample,
                                 std::optional<std::uint32_t> passedOver)
    : m_visibility(visibility), m_passedOver(passedOver) {
  if (!visibility) return;
  const glm::dvec3 position(sample.position), geometric = glm::normalize(glm::dvec3(sample.geometricNormal));
  m_horizon = geometric;
  glm::dvec3 lift(0);
  // The sample's own triangle: straight below where its rays leave it.
  const double offset = visibility->surfaceOffset(position);
  const auto own = visibility->firstHit(visibility->leaveSurface(position, geometric), -geometric, 2 * offset);
  constexpr double kSameTriangle = 0.999; // cosine: the sample's normal is within 5e-5 radians
  if (own && std::abs(glm::dot(glm::dvec3(own->geometric), geometric)) > kSameTriangle) {
    const lighting::SurfacePoint point = lighting::surfacePointAt(visibility->scene(), *own, -geometric);
    if (glm::dot(point.smooth, geometric) > 0) m_horizon = point.smooth;
    lift = point.lift;
  }
  setOrigin(position, geometric, lift);
}

PointVisibility::PointVisibility(const lighting::Visibility& visibility, const lighting::SurfacePoint& point)
    : m_visibility(&visibility),
      m_horizon(glm::dot(point.smooth, point.geometric) > 0 ? point.smooth : point.geometric) {
  setOrigin(point.position, point.geometric, point.lift);
}

void PointVisibility::setOrigin(const glm::dvec3& position, const glm::dvec3& geometric, const glm::dvec3& lift) {
  m_position = position;
  m_offset = m_visibility->surfaceOffset(position);
  m_origin = m_visibility->leaveSurface(position, geometric);
  // Something else may lie between facet and smooth surface: then rays begin at the facet.
  const double height = glm::length(lift);
  if (height > 0 && isOpen(lift / height, height)) m_origin += lift;
}

bool PointVisibility::reaches(const glm::dvec3& direction, double distance) const {
  if (!m_visibility) return true;
  if (!isAboveHorizon(direction)) return false;
  if (std::isinf(distance)) return isOpen(direction, distance);
  const glm::dvec3 way = m_position + distance * direction - m_origin;
  const double length = glm::length(way);
  return !(length > 0) || isOpen(way / length, length - 2 * m_offset);
}

bool PointVisibility::isOpen(const glm::dvec3& direction, double length) const {
  if (m_passedOver) return !m_visibility->firstHitBeside(*m_passedOver, m_origin, direction, length);
  return !m_visibility->isOccluded(m_origin, direction, length);
}

std::optional<lighting::Visibility::Hit> PointVisibility::firstHit(const glm::dvec3& direction) const {
  if (!m_visibility || !isAboveHorizon(direction)) return std::nullopt;
  return m_passedOver ? m_visibility->firstHitBeside(*m_passedOver, m_origin, direction)
                      : m_visibility->firstHit(m_origin, direction);
}

} // namespace parity::reference
