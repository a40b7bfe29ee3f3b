// From where light reaches one point of a surface.
#pragma once

#include <limits>
#include <optional>

#include "lighting/surface/surface_point.h"
#include "lighting/surface/visibility.h"
#include "reference/surface_sample.h"

namespace parity::reference {

// The surface is the one that the vertices' normals tell of, not its facets: rays begin on it (lighting::SurfacePoint's
// lift), and what hides a direction by lying below the point is its tangent plane, the horizon. Where nothing of the
// scene lies at the sample (blended surfaces), both are the triangle's.
class PointVisibility {
public:
  // Nothing casts shadows: light comes from everywhere, and there is no horizon.
  PointVisibility() = default;
  // visibility: null where nothing casts shadows. It and its scene must outlive this.
  // passedOver: an instance that bounds a body (Visibility::firstHitBeside) and hides nothing from here.
  PointVisibility(const lighting::Visibility* visibility, const SurfaceSample& sample,
                  std::optional<std::uint32_t> passedOver = std::nullopt);
  PointVisibility(const lighting::Visibility& visibility, const lighting::SurfacePoint& point);

  bool hasHorizon() const { return m_visibility != nullptr; }
  const glm::dvec3& horizonNormal() const { return m_horizon; } // unit, world
  bool isAboveHorizon(const glm::dvec3& direction) const { return !m_visibility || glm::dot(m_horizon, direction) > 0; }
  // The direction's image in the tangent plane.
  glm::dvec3 mirror(const glm::dvec3& direction) const {
    return direction - 2 * glm::dot(m_horizon, direction) * m_horizon;
  }

  // direction: world, unit; distance: from the point to the light. What stands below the horizon is hidden by the
  // surface itself, wherever the shading normal points. A light is not hidden by what lies at its own place.
  bool reaches(const glm::dvec3& direction, double distance = std::numeric_limits<double>::infinity()) const;

  // Whether nothing lies on the ray that begins at origin(), as far as a length that may be infinite.
  bool isOpen(const glm::dvec3& direction, double length) const;

  // The first surface in a direction above the horizon; nothing below it, or where nothing casts shadows.
  std::optional<lighting::Visibility::Hit> firstHit(const glm::dvec3& direction) const;

  // Where rays begin.
  const glm::dvec3& origin() const { return m_origin; }

private:
  void setOrigin(const glm::dvec3& position, const glm::dvec3& geometric, const glm::dvec3& lift);

  const lighting::Visibility* m_visibility = nullptr;
  glm::dvec3 m_position{0.0}, m_horizon{0.0}, m_origin{0.0};
  double m_offset = 0;
  std::optional<std::uint32_t> m_passedOver;
};

} // namespace parity::reference
