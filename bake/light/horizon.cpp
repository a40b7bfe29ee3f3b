// Packing by horizons.
#include "bake/light/horizon.h"

#include <algorithm>
#include <limits>

#include "bake/atlas/raster.h"

namespace parity::bake {
Profile makeProfile(const FlatChart& chart, int padding) {
  const int width = chart.size.x, height = chart.size.y;
  std::vector<int> low(static_cast<std::size_t>(width), height + padding), high(low.size(), 0);
  for (const FlatFace& face : chart.corners) {
    forEachTouched(face, kTouchSlack, width, height, [&](int x, int begin, int end) {
      const auto column = static_cast<std::size_t>(x);
      low[column] = std::min(low[column], begin);
      high[column] = std::max(high[column], end + padding);
    });
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
