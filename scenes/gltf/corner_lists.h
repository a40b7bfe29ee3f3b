// The corners of a triangle list, listed by the vertex that they lie at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace parity::scenes {

// Corner c is place c of the index list. The corners at a vertex stand in ascending order.
class CornerLists {
public:
  // vertexAt: for each corner its vertex, below vertexCount.
  CornerLists(std::span<const std::uint32_t> vertexAt, std::size_t vertexCount)
      : m_begin(vertexCount + 1, 0), m_corners(vertexAt.size()) {
    for (const std::uint32_t vertex : vertexAt) ++m_begin[vertex + 1];
    for (std::size_t v = 0; v < vertexCount; ++v) m_begin[v + 1] += m_begin[v];
    std::vector<std::uint32_t> next(m_begin.begin(), m_begin.end() - 1);
    for (std::size_t c = 0; c < vertexAt.size(); ++c) m_corners[next[vertexAt[c]]++] = static_cast<std::uint32_t>(c);
  }

  std::size_t vertexCount() const { return m_begin.size() - 1; }
  std::span<const std::uint32_t> at(std::size_t vertex) const {
    return std::span(m_corners).subspan(m_begin[vertex], m_begin[vertex + 1] - m_begin[vertex]);
  }

private:
  std::vector<std::uint32_t> m_begin, m_corners;
};

} // namespace parity::scenes
