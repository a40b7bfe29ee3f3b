// Directions of equal probability.
#pragma once

#include <random>

#include <glm/glm.hpp>

namespace parity::tests {

inline glm::dvec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

} // namespace parity::tests
