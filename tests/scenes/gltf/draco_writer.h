// Draco streams made by the tests, by libdraco's encoder.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace parity::tests {

struct DracoSource {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uv;
  std::vector<std::uint32_t> joints; // four 8-bit ones a vertex; empty: none
  std::vector<std::uint32_t> indices;
};

// Unique ids of the attributes in the order of DracoSource: 0 positions, 1 normals, 2 uv, 3 joints, those that there
// are. edgebreaker: false for the sequential encoding. Positions and uv are not quantised unless positionBits says so.
std::vector<std::byte> encodeDraco(const DracoSource& source, bool edgebreaker, int positionBits = 0);

} // namespace parity::tests
