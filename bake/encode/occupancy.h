// Cells of a grid that triangles have taken: finds those that lie over each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace parity::bake {

// Sub-texels along a texel's side, for every check of a layout.
inline constexpr int kSubTexels = 4;

class Occupancy {
public:
  // width and height in cells.
  Occupancy(int width, int height);

  // Whether a triangle (in cells) holds a cell's middle that another one added before holds, too. Middles nearer than
  // 1/50 of a cell to an edge are nobody's: triangles that share an edge do not overlap for a rounding error.
  bool overlaps(const std::array<glm::dvec2, 3>& triangle) const;
  void add(const std::array<glm::dvec2, 3>& triangle);

private:
  int m_width, m_height;
  std::size_t m_wordsPerRow;
  std::vector<std::uint64_t> m_bits;
};

} // namespace parity::bake
