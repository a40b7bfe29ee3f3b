#include "reference/bright_cells.h"

#include <numbers>

namespace parity::reference {

namespace {

using std::numbers::pi;
constexpr int kBands = 16;

} // namespace

glm::dvec3 lightOf(int width, std::span<const glm::vec4> cells, std::span<const double> rowY) {
  glm::dvec3 sum(0);
  for (std::size_t y = 0; y + 1 < rowY.size(); ++y) {
    glm::dvec3 inRow(0);
    for (const glm::vec4& cell : cells.subspan(y * width, static_cast<std::size_t>(width))) inRow += glm::dvec3(cell);
    sum += inRow * (2 * pi / width * (rowY[y] - rowY[y + 1]));
  }
  for (int c = 0; c < 3; ++c)
    if (!(sum[c] > 0)) sum[c] = 1;
  return sum;
}

std::vector<BrightCell> findBrightCells(int width, std::span<const glm::vec4> cells, std::span<const double> rowY,
                                        const glm::dvec3& allLight) {
  const double turn = 2 * pi / width;
  std::vector<BrightCell> bright;
  for (std::size_t y = 0; y + 1 < rowY.size(); ++y) {
    const double top = rowY[y], bottom = rowY[y + 1], radius = radiusUntil(top) - radiusUntil(bottom);
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 radiance(cells[y * width + x]);
      if (!isBright(radiance / allLight * (turn * (top - bottom)))) continue;
      const double left = x * turn - pi, right = left + turn;
      const glm::dvec3 direction = {radius * (std::sin(right) - std::sin(left)),
                                    0.5 * turn * (top * top - bottom * bottom),
                                    radius * (std::cos(left) - std::cos(right))};
      bright.push_back({left, right, top, bottom, radiance, direction});
    }
  }
  return bright;
}

glm::dvec3 BrightCell::irradiance(const glm::dvec3& n) const {
  // No two directions of the cell are farther apart than this.
  const double reach = right - left + std::acos(bottom) - std::acos(top);
  const double whole = glm::dot(n, direction), length = glm::length(direction);
  if (whole <= -reach * length) return glm::dvec3(0);
  if (whole >= reach * length) return radiance * whole;
  const double horizontal = std::hypot(n.x, n.z), azimuth = std::atan2(n.z, n.x);
  double sum = 0;
  for (int band = 0; band < kBands; ++band) {
    const double from = glm::mix(top, bottom, static_cast<double>(band) / kBands);
    const double to = glm::mix(top, bottom, (band + 1.0) / kBands);
    // N.w = n_y y + horizontal sqrt(1 - y^2) cos(a - azimuth), integrated over the band.
    const double constant = n.y * 0.5 * (from * from - to * to);
    const double swing = horizontal * (radiusUntil(from) - radiusUntil(to));
    if (constant <= -swing) continue;
    const double half = constant >= swing ? pi : std::acos(-constant / swing);
    for (const double around : {-2 * pi, 0.0, 2 * pi}) {
      const double begin = std::max(left + around, azimuth - half), end = std::min(right + around, azimuth + half);
      if (begin < end) sum += constant * (end - begin) + swing * (std::sin(end - azimuth) - std::sin(begin - azimuth));
    }
  }
  return radiance * sum;
}

} // namespace parity::reference
