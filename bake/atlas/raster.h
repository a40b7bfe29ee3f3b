// Which cells of a grid a triangle covers, row by row.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/glm.hpp>

namespace parity::bake {

// Twice the signed area of a triangle in the plane.
inline double doubleArea(const std::array<glm::dvec2, 3>& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
}

// Calls body(y, begin, end) for each row of a grid of width x height unit cells: the cells [begin, end) of row y have
// their middles inside the triangle, at least `inset` away from its edges (negative: as far outside of them). Triangles
// of both windings; nothing for one without area. Row by row, so that a large triangle costs its rows and not its
// cells.
template <typename Body>
void forEachSpan(const std::array<glm::dvec2, 3>& t, double inset, int width, int height, const Body& body) {
  const double area = doubleArea(t);
  if (area == 0) return;
  // Edge k: the middles p with dot(normal, p) >= offset; the normal is unit and points inwards.
  std::array<glm::dvec2, 3> normal;
  std::array<double, 3> offset{};
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 edge = t[(k + 1) % 3] - t[k];
    normal[k] = glm::dvec2(-edge.y, edge.x) * ((area > 0 ? 1 : -1) / glm::length(edge));
    offset[k] = glm::dot(normal[k], t[k]) + inset;
  }
  const double outset = std::max(0.0, -inset);
  const double lowest = std::min({t[0].y, t[1].y, t[2].y}) - outset,
               highest = std::max({t[0].y, t[1].y, t[2].y}) + outset;
  const double left = std::min({t[0].x, t[1].x, t[2].x}) - outset, right = std::max({t[0].x, t[1].x, t[2].x}) + outset;
  const auto firstCell = [](double from) { return std::ceil(from - 0.5); };
  const auto lastCell = [](double to) { return std::floor(to - 0.5); };
  const int yBegin = static_cast<int>(std::clamp(firstCell(lowest), 0.0, static_cast<double>(height)));
  const int yEnd = static_cast<int>(std::clamp(lastCell(highest) + 1, 0.0, static_cast<double>(height)));
  for (int y = yBegin; y < yEnd; ++y) {
    double from = left, to = right;
    for (std::size_t k = 0; k < 3; ++k) {
      const double rest = offset[k] - normal[k].y * (y + 0.5);
      if (normal[k].x > 1e-12)
        from = std::max(from, rest / normal[k].x);
      else if (normal[k].x < -1e-12)
        to = std::min(to, rest / normal[k].x);
      else if (rest > 0)
        to = from - 1;
    }
    const int begin = static_cast<int>(std::clamp(firstCell(from), 0.0, static_cast<double>(width)));
    const int end = static_cast<int>(std::clamp(lastCell(to) + 1, 0.0, static_cast<double>(width)));
    if (begin < end) body(y, begin, end);
  }
}

// Cells by which a corner may lie beyond a cell's border and is still taken to lie on it: rounding.
inline constexpr double kTouchSlack = 1e-3;

// Calls body(x, begin, end) for each column of the grid that a triangle touches: it touches the cells [begin, end), be
// it by a tip that holds no middle of a cell. It reaches into a column or a row that counts by more than `slack`; of a
// triangle narrower than that, the cell that it begins in counts.
template <typename Body>
void forEachTouched(const std::array<glm::dvec2, 3>& t, double slack, int width, int height, const Body& body) {
  const auto firstCell = [&](double from, int count) {
    return std::clamp(static_cast<int>(std::floor(from + slack)), 0, count - 1);
  };
  const auto lastCell = [&](double to, int first, int count) {
    return std::clamp(static_cast<int>(std::ceil(to - slack)), first + 1, count);
  };
  const int xBegin = firstCell(std::min({t[0].x, t[1].x, t[2].x}), width);
  const int xEnd = lastCell(std::max({t[0].x, t[1].x, t[2].x}), xBegin, width);
  for (int x = xBegin; x < xEnd; ++x) {
    // The rows of the part of each edge that lies within the column.
    double lowest = std::numeric_limits<double>::max(), highest = std::numeric_limits<double>::lowest();
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2& left = t[k].x <= t[(k + 1) % 3].x ? t[k] : t[(k + 1) % 3];
      const glm::dvec2& right = t[k].x <= t[(k + 1) % 3].x ? t[(k + 1) % 3] : t[k];
      if (right.x < x || left.x > x + 1) continue;
      const double run = right.x - left.x;
      const double from = run > 0 ? std::max(0.0, (x - left.x) / run) : 0;
      const double to = run > 0 ? std::min(1.0, (x + 1 - left.x) / run) : 1;
      for (const double at : {from, to}) {
        const double y = left.y + at * (right.y - left.y);
        lowest = std::min(lowest, y);
        highest = std::max(highest, y);
      }
    }
    if (lowest > highest) continue;
    const int yBegin = firstCell(lowest, height);
    body(x, yBegin, lastCell(highest, yBegin, height));
  }
}

} // namespace parity::bake
