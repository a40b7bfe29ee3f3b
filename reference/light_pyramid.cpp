#include "reference/light_pyramid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "reference/bright_cells.h"

namespace parity::reference {

namespace {

using std::numbers::pi;
constexpr std::size_t kRowsAtOnce = 16;

// Along the meridian to the farther row, then along the widest circle of latitude. top, bottom: polar angles.
double radiusOf(double top, double bottom, double halfWidth) {
  const double widest = top < pi / 2 && bottom > pi / 2 ? 1 : std::max(std::sin(top), std::sin(bottom));
  return std::min(pi, 0.5 * (bottom - top) + halfWidth * widest);
}

} // namespace

LightShares sharesOf(double upperLeft, double upperRight, double lowerLeft, double lowerRight) {
  const auto share = [](double first, double second) {
    return first > 0 ? static_cast<float>(first / (first + second)) : 0.f;
  };
  return {share(upperLeft + upperRight, lowerLeft + lowerRight), share(upperLeft, upperRight),
          share(lowerLeft, lowerRight)};
}

LightPyramid::LightPyramid(int width, int height, std::span<const glm::vec4> cells, std::span<const double> rowY)
    : m_rowY(rowY.begin(), rowY.end()) {
  for (int w = width, h = height;; w = (w + 1) / 2, h = (h + 1) / 2) {
    Level level;
    level.width = w;
    level.height = h;
    level.power.resize(static_cast<std::size_t>(w) * h);
    const double side = std::ldexp(1.0, static_cast<int>(m_levels.size()));
    const auto angles = [&](int count, int all, double turn, double from, auto&& put) {
      for (int i = 0; i < count; ++i)
        put(from + turn * i * side / all, from + turn * std::min((i + 1) * side, static_cast<double>(all)) / all);
    };
    angles(w, width, 2 * pi, -pi, [&](double left, double right) {
      const double a = 0.5 * (left + right);
      level.azimuth.emplace_back(std::cos(a), std::sin(a));
      level.halfWidth.push_back(0.5 * (right - left));
    });
    const double halfWidth = std::min(pi, pi * side / width);
    angles(h, height, pi, 0, [&](double top, double bottom) {
      const double a = 0.5 * (top + bottom);
      level.polar.emplace_back(std::cos(a), std::sin(a));
      level.halfHeight.push_back(0.5 * (bottom - top));
      level.radius.push_back(radiusOf(top, bottom, halfWidth));
    });
    m_levels.push_back(std::move(level));
    if (w == 1 && h == 1) break;
  }
  for (std::size_t l = 0; l < m_levels.size(); ++l) {
    Level& level = m_levels[l];
    if (l > 0) {
      level.shares.resize(level.power.size());
      level.moments.resize(level.power.size());
    }
    base::parallelFor(static_cast<std::size_t>(level.height), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y)
        for (int x = 0; x < level.width; ++x) {
          double& power = level.power[y * level.width + x];
          if (l == 0) {
            const double area = (m_rowY[y] - m_rowY[y + 1]) * 2 * pi / width;
            power = static_cast<double>(cells[y * width + x].w) * area;
          } else {
            const int below = static_cast<int>(l) - 1, top = 2 * static_cast<int>(y);
            const double quarters[] = {this->power({below, 2 * x, top}), this->power({below, 2 * x + 1, top}),
                                       this->power({below, 2 * x, top + 1}), this->power({below, 2 * x + 1, top + 1})};
            power = (quarters[0] + quarters[1]) + (quarters[2] + quarters[3]);
            level.shares[y * level.width + x] = sharesOf(quarters[0], quarters[1], quarters[2], quarters[3]);
            LightMoments& sum = level.moments[y * level.width + x];
            const Level& finer = m_levels[l - 1];
            for (int v = top; v < std::min(top + 2, finer.height); ++v)
              for (int u = 2 * x; u < std::min(2 * x + 2, finer.width); ++u) {
                const LightMoments part =
                    moments({below, u, v},
                            below == 0 ? glm::vec3(cells[static_cast<std::size_t>(v) * width + u]) : glm::vec3(0));
                sum.light += part.light;
                sum.x += part.x;
                sum.y += part.y;
                sum.z += part.z;
              }
          }
        }
    });
  }
}

LightPyramid::Bounds LightPyramid::boundsOf(const PanoramaBlock& block) const {
  const PanoramaBlock cell = cellOf(block);
  const double part = std::ldexp(1.0, block.level), turn = 2 * pi / width() * part;
  const double top = m_rowY[cell.y], fall = m_rowY[cell.y + 1] - top, below = block.y * part - cell.y;
  return {block.x * turn - pi, (block.x + 1) * turn - pi, top + fall * below, top + fall * (below + part)};
}

// The integrals of direction over a cell or a part of one are in closed form.
LightMoments LightPyramid::momentsOf(const Bounds& b, const glm::vec3& radiance) const {
  const glm::dvec3 L(radiance);
  const double radius = radiusUntil(b.top) - radiusUntil(b.bottom), turn = b.right - b.left;
  return {L * (turn * (b.top - b.bottom)), L * (radius * (std::sin(b.right) - std::sin(b.left))),
          L * (0.5 * turn * (b.top * b.top - b.bottom * b.bottom)),
          L * (radius * (std::cos(b.left) - std::cos(b.right)))};
}

LightMoments LightPyramid::moments(const PanoramaBlock& block, const glm::vec3& radiance) const {
  if (block.level <= 0) return momentsOf(boundsOf(block), radiance);
  const Level& level = m_levels[static_cast<std::size_t>(block.level)];
  return level.moments[static_cast<std::size_t>(block.y) * level.width + block.x];
}

BlockFrame LightPyramid::frameOfPart(const PanoramaBlock& block) const {
  const Bounds bounds = boundsOf(block);
  const double top = std::acos(bounds.top), bottom = std::acos(bounds.bottom), middle = 0.5 * (top + bottom);
  const double azimuth = 0.5 * (bounds.left + bounds.right), halfWidth = 0.5 * (bounds.right - bounds.left);
  return makeFrame({std::cos(middle), std::sin(middle)}, {std::cos(azimuth), std::sin(azimuth)}, halfWidth,
                   0.5 * (bottom - top), radiusOf(top, bottom, halfWidth));
}

glm::dvec3 LightPyramid::directionIn(const PanoramaBlock& block, const glm::dvec2& u) const {
  const Bounds bounds = boundsOf(block);
  const double azimuth = glm::mix(bounds.left, bounds.right, u.x), height = glm::mix(bounds.top, bounds.bottom, u.y);
  const double r = std::sqrt(std::max(0.0, 1 - height * height));
  return {r * std::cos(azimuth), height, r * std::sin(azimuth)};
}

} // namespace parity::reference
