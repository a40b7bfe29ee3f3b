// The cells of a panorama that hold so much of its light that a surface's horizon must be cut out of them exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace parity::reference {

// Panoramas are given by radiance, row by row, the top first, w not read, and by the bounds of the rows as heights on
// the unit sphere, 1 .. -1. Directions are the panorama's own: y up, azimuth atan2(z, x) from -pi at the left rim.

// The integral of sqrt(1 - y^2) dy from 0: y in [-1, 1].
inline double radiusUntil(double y) { return 0.5 * (y * std::sqrt(std::max(0.0, 1 - y * y)) + std::asin(y)); }

// The integral of radiance over all directions, each channel; 1 where that is 0.
glm::dvec3 lightOf(int width, std::span<const glm::vec4> cells, std::span<const double> rowY);

// share: a cell's light over lightOf.
inline bool isBright(const glm::dvec3& share) {
  constexpr double kBrightShare = 1e-3;
  return std::max({share.x, share.y, share.z}) > kBrightShare;
}

struct BrightCell {
  double left, right, top, bottom; // in azimuth and height
  glm::dvec3 radiance;
  glm::dvec3 direction; // integrated over the cell

  // Of a surface: exact but for the azimuth of its horizon, which is one along a 16th of the cell's height.
  glm::dvec3 irradiance(const glm::dvec3& normal) const;
};

std::vector<BrightCell> findBrightCells(int width, std::span<const glm::vec4> cells, std::span<const double> rowY,
                                        const glm::dvec3& allLight);

} // namespace parity::reference
