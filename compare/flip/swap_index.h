// Where the pixels of a swapped picture lie: found by rows and columns, for the tiles of flip_swap.cpp.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "compare/flip/flip_swap.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

class SwapIndex {
public:
  SwapIndex() = default;
  // swap: must outlive the index; its pixels ascend and lie within an image of this size.
  SwapIndex(const FlipSwap& swap, int width, int height);

  const FlipSwap& swap() const { return *m_swap; }
  // The places in the list, begin and end, of the pixels in columns x0..x1-1 of row y.
  std::pair<std::uint32_t, std::uint32_t> placesOf(int y, int x0, int x1) const;
  // Of the pixel at that place.
  int columnOf(std::uint32_t place) const { return static_cast<int>(m_swap->pixels[place] % m_width); }
  // Whether the box that holds all of its pixels meets this one.
  bool touches(const Rect& box) const;

private:
  const FlipSwap* m_swap = nullptr;
  std::uint32_t m_width = 1;
  std::vector<std::uint32_t> m_rowStart; // height + 1: the first place of each row
  Rect m_bounds;
};

} // namespace parity::compare
