// A plane's values as a list, to compare and to change them.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "gpu/surface/shaded_plane.h"

namespace parity::tests {

inline std::vector<glm::vec4> valuesOf(const gpu::ShadedPlane& plane) {
  std::vector<glm::vec4> values;
  for (std::size_t i = 0; i < plane.size(); ++i) values.push_back(plane[i]);
  return values;
}

// Of NaN and of both zeros, too.
inline bool haveSameBits(const gpu::ShadedPlane& a, const gpu::ShadedPlane& b) {
  const std::vector<glm::vec4> first = valuesOf(a), second = valuesOf(b);
  return first.size() == second.size() &&
         (first.empty() || std::memcmp(first.data(), second.data(), first.size() * sizeof(glm::vec4)) == 0);
}

} // namespace parity::tests
