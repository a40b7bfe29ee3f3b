// Cells that are taken: a bit each, whole words at a time.
#include "bake/encode/occupancy.h"

#include "bake/atlas/raster.h"

namespace parity::bake {
namespace {

constexpr double kInset = 0.02;

// Calls body(word, mask) for the bits [begin, end) of a row.
template <typename Body> void forEachWord(int begin, int end, const Body& body) {
  for (int word = begin / 64; word * 64 < end; ++word) {
    std::uint64_t mask = ~std::uint64_t{0};
    if (begin > word * 64) mask <<= begin - word * 64;
    if (end < word * 64 + 64) mask &= ~std::uint64_t{0} >> (word * 64 + 64 - end);
    body(static_cast<std::size_t>(word), mask);
  }
}

} // namespace

Occupancy::Occupancy(int width, int height)
    : m_width(width), m_height(height), m_wordsPerRow(static_cast<std::size_t>(width + 63) / 64),
      m_bits(m_wordsPerRow * static_cast<std::size_t>(height)) {}

bool Occupancy::overlaps(const std::array<glm::dvec2, 3>& triangle) const {
  bool found = false;
  forEachSpan(triangle, kInset, m_width, m_height, [&](int y, int begin, int end) {
    const std::uint64_t* row = m_bits.data() + static_cast<std::size_t>(y) * m_wordsPerRow;
    forEachWord(begin, end, [&](std::size_t word, std::uint64_t mask) { found = found || (row[word] & mask) != 0; });
  });
  return found;
}

void Occupancy::add(const std::array<glm::dvec2, 3>& triangle) {
  forEachSpan(triangle, kInset, m_width, m_height, [&](int y, int begin, int end) {
    std::uint64_t* row = m_bits.data() + static_cast<std::size_t>(y) * m_wordsPerRow;
    forEachWord(begin, end, [&](std::size_t word, std::uint64_t mask) { row[word] |= mask; });
  });
}

} // namespace parity::bake
