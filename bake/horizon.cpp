// Packing by horizons.
#include "bake/horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::bake {
namespace {

// Texels by which a corner may lie beyond a texel's border without touching the next one: rounding.
constexpr double kSlack = 1e-3;

// The rows of a face within the column [x, x + 1].
glm::dvec2 rowsWithin(const FlatFace& face, int x) {
  glm::dvec2 rows(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
  for (std::size_t k = 0; k < 3; ++k) {
    glm::dvec2 a = face[k], b = face[(k + 1) % 3];
    if (a.x > b.x) std::swap(a, b);
    if (b.x < x || a.x > x + 1) continue;
    for (const double at : {std::max<double>(a.x, x), std::min<double>(b.x, x + 1)}) {
      const double y = b.x > a.x ? a.y + (b.y - a.y) * (at - a.x) / (b.x - a.x) : a.y;
      rows = {std::min(rows.x, y), std::max(rows.y, y)};
    }
    if (a.x == b.x) rows = {std::min(rows.x, b.y), std::max(rows.y, b.y)};
  }
  return rows;
}

} // namespace

Profile makeProfile(const FlatChart& chart, int padding) {
  const int width = chart.size.x, height = chart.size.y;
  std::vector<int> low(static_cast<std::size_t>(width), height + padding), high(low.size(), 0);
  for (const FlatFace& face : chart.corners) {
    const double left = std::min({face[0].x, face[1].x, face[2].x}),
                 right = std::max({face[0].x, face[1].x, face[2].x});
    const int begin = std::clamp(static_cast<int>(std::floor(left + kSlack)), 0, width - 1);
    const int end = std::clamp(static_cast<int>(std::ceil(right - kSlack)), begin + 1, width);
    for (int x = begin; x < end; ++x) {
      const glm::dvec2 rows = rowsWithin(face, x);
      if (rows.x > rows.y) continue;
      const int first = std::clamp(static_cast<int>(std::floor(rows.x + kSlack)), 0, height - 1);
      const int last = std::clamp(static_cast<int>(std::ceil(rows.y - kSlack)), first + 1, height);
      const auto column = static_cast<std::size_t>(x);
      low[column] = std::min(low[column], first);
      high[column] = std::max(high[column], last + padding);
    }
  }
  Profile profile;
  for (int x = 0; x < width + padding; ++x) {
    const int begin = std::max(0, x - padding), end = std::min(width - 1, x) + 1;
    profile.low.push_back(static_cast<std::uint16_t>(*std::min_element(low.begin() + begin, low.begin() + end)));
    profile.high.push_back(static_cast<std::uint16_t>(*std::max_element(high.begin() + begin, high.begin() + end)));
  }
  return profile;
}

Horizon::Horizon(int width, int height) : m_height(height), m_heights(static_cast<std::size_t>(width), 0) {}

std::optional<glm::ivec2> Horizon::place(const glm::ivec2& size, const Profile& profile) {
  const int columns = static_cast<int>(m_heights.size());
  glm::ivec2 best(-1, m_height - size.y);
  std::int64_t leastFree = std::numeric_limits<std::int64_t>::max();
  for (int x = 0; x + size.x <= columns; ++x) {
    const int* heights = m_heights.data() + x;
    int y = 0;
    for (int i = 0; i < size.x && y <= best.y; ++i)
      y = std::max(y, heights[i] - profile.low[static_cast<std::size_t>(i)]);
    if (y > best.y) continue;
    std::int64_t free = 0;
    for (int i = 0; i < size.x; ++i) free += y + profile.low[static_cast<std::size_t>(i)] - heights[i];
    if (y == best.y && free >= leastFree) continue;
    best = {x, y};
    leastFree = free;
  }
  if (best.x < 0) return std::nullopt;
  for (int i = 0; i < size.x; ++i) {
    int& height = m_heights[static_cast<std::size_t>(best.x + i)];
    const int high = profile.high[static_cast<std::size_t>(i)];
    if (high > 0) height = std::max(height, best.y + high);
  }
  m_usedHeight = std::max(m_usedHeight, best.y + size.y);
  return best;
}

} // namespace parity::bake
