// The smallest square about points of a plane.
#pragma once

#include <cmath>
#include <vector>

#include <glm/glm.hpp>

namespace parity::gpu {

struct Square {
  glm::vec2 axis{1.f, 0.f}, center{0.f}; // axis: of one side, unit
  float halfSide = INFINITY;             // of no points
};

// The smallest of those that share a direction with an edge of the points' hull. Points: finite, their squares too.
Square smallestSquare(const std::vector<glm::vec2>& points);

} // namespace parity::gpu
