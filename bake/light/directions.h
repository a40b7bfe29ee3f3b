// Directions about points of a surface whose normals are near each other.
#pragma once

#include <span>

#include <glm/glm.hpp>

namespace parity::bake {

// About one axis for all points, so that the same numbers mean the same direction at each of them. The density is
// between the cosine's and a uniform one, so that light summed without the cosine, too, has a bounded weight; uniform
// alone where only some of the points have the direction above them.
class Directions {
public:
  // normals: unit, at least one. bothSides: over the whole sphere, front and back alike.
  Directions(std::span<const glm::vec3> normals, bool bothSides);

  // Unit; u in (0, 1)^2. Continuous in u but where azimuth begins, and between the sides.
  glm::dvec3 at(glm::dvec2 u) const;
  // Of taking this direction, per steradian. Not zero for what is above one of the points.
  double pdf(const glm::dvec3& direction) const;

private:
  glm::dvec3 m_x{0.0}, m_y{0.0}, m_axis{0.0};
  bool m_bothSides;
  double m_below = 0; // the least cosine is -m_below
  double m_even = 0;  // uniform density of the cosine, from -m_below to 1
};

} // namespace parity::bake
