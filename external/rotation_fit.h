// The rotation that takes directions to others, by least squares (Davenport's q method; Wahba 1965).
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace parity::external {

struct RotationFit {
  glm::dmat3 rotation{1.0};
  double angleDeg = 0; // of the rotation
  double errorDeg = 0; // root of the mean square angle that is left
};

// Unit vectors, as many of each, two at least that are not parallel.
RotationFit fitRotation(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to);

} // namespace parity::external
