// Which cells of a grid a triangle covers, row by row.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

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

} // namespace parity::bake
