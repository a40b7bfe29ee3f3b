// From where light reaches one point of a surface.
#pragma once

#include <limits>

#include "lighting/visibility.h"
#include "reference/surface_sample.h"

namespace parity::reference {

class PointVisibility {
public:
  // visibility: null where nothing casts shadows: light comes from everywhere. It must outlive this.
  PointVisibility(const lighting::Visibility* visibility, const SurfaceSample& sample) : m_visibility(visibility) {
    if (!visibility) return;
    m_normal = glm::normalize(glm::dvec3(sample.geometricNormal));
    m_offset = visibility->surfaceOffset(sample.position);
    m_origin = visibility->leaveSurface(sample.position, m_normal);
  }

  // direction: world, unit; distance: to the light. What stands below the geometric surface is hidden by the surface
  // itself, wherever the shading normal points. A light is not hidden by what lies at its own place.
  bool reaches(const glm::dvec3& direction, double distance = std::numeric_limits<double>::infinity()) const {
    return !m_visibility || (glm::dot(m_normal, direction) > 0 &&
                             !m_visibility->isOccluded(m_origin, direction, distance - 2 * m_offset));
  }

private:
  const lighting::Visibility* m_visibility;
  glm::dvec3 m_normal{0.0}, m_origin{0.0};
  double m_offset = 0;
};

} // namespace parity::reference
