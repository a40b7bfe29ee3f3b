// Where the light of neighbouring texels varies: directions are taken more often there.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace parity::bake {

// A density over the unit square that directions are made from (bake/light/directions.h), constant in each of its
// cells.
class DirectionGuide {
public:
  static constexpr int kRows = 16,
                       kColumns = 64; // along u.x, the cosine; along u.y, azimuth: cells nearly as wide as high
  static constexpr std::size_t kCells = std::size_t{kRows} * kColumns;
  static std::size_t cellOf(const glm::dvec2& u) {
    const auto within = [](double v, int count) { return std::min(static_cast<int>(v * count), count - 1); };
    return static_cast<std::size_t>(within(u.x, kRows)) * kColumns + within(u.y, kColumns);
  }

  DirectionGuide() = default; // even
  // wanted: of each cell, row by row; above zero.
  explicit DirectionGuide(const std::array<double, kCells>& wanted);

  // Takes u in (0, 1)^2 to a point of that density, which it returns (of mean 1): near points stay near, rows by their
  // sums and then columns of a row.
  double warp(glm::dvec2& u) const;

private:
  std::vector<double> m_rows;    // cumulative, 0 .. 1; empty: even
  std::vector<double> m_columns; // kColumns + 1 for each row
};

} // namespace parity::bake
