#include "compare/flip/swap_index.h"

#include <algorithm>

namespace parity::compare {

SwapIndex::SwapIndex(const FlipSwap& swap, int width, int height)
    : m_swap(&swap), m_width(static_cast<std::uint32_t>(width)), m_rowStart(static_cast<std::size_t>(height) + 1, 0) {
  int left = width, right = 0;
  for (const std::uint32_t pixel : swap.pixels) {
    const int x = static_cast<int>(pixel % m_width);
    left = std::min(left, x), right = std::max(right, x + 1);
    ++m_rowStart[pixel / m_width + 1];
  }
  for (std::size_t y = 1; y < m_rowStart.size(); ++y) m_rowStart[y] += m_rowStart[y - 1];
  if (swap.pixels.empty()) return;
  const int top = static_cast<int>(swap.pixels.front() / m_width),
            bottom = static_cast<int>(swap.pixels.back() / m_width) + 1;
  m_bounds = {left, top, right - left, bottom - top};
}

std::pair<std::uint32_t, std::uint32_t> SwapIndex::placesOf(int y, int x0, int x1) const {
  const auto row = static_cast<std::size_t>(y);
  const auto begin = m_swap->pixels.begin() + m_rowStart[row], end = m_swap->pixels.begin() + m_rowStart[row + 1];
  if (begin == end) return {0, 0};
  const std::uint32_t first = static_cast<std::uint32_t>(y) * m_width;
  const auto from = std::lower_bound(begin, end, first + static_cast<std::uint32_t>(x0)),
             to = std::lower_bound(from, end, first + static_cast<std::uint32_t>(x1));
  return {static_cast<std::uint32_t>(from - m_swap->pixels.begin()),
          static_cast<std::uint32_t>(to - m_swap->pixels.begin())};
}

bool SwapIndex::touches(const Rect& box) const {
  return !m_bounds.empty() && m_bounds.x < box.x + box.width && box.x < m_bounds.x + m_bounds.width &&
         m_bounds.y < box.y + box.height && box.y < m_bounds.y + m_bounds.height;
}

} // namespace parity::compare
