// Where two images differ in any bit, in cells of a few pixels: what is alike need not be filtered.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// Throws Error (failed) "<name>: x 3, y 7: 12 pixels are NaN or infinite, this is the first" where there are any in the
// box. All channels count.
void requireFinite(const PixelView& view, const Rect& box, const char* name);

// Of a box of two images of equal size, channels and type.
class DifferenceMap {
public:
  static constexpr int kCellWidth = 8; // pixels of one row

  // Reads the box of both images once, on all cores. Throws Error (failed) for NaN or infinite values in it, with their
  // count and the first position: equal pixels are not exempt.
  DifferenceMap(const PixelView& reference, const PixelView& test, const Rect& box);

  // Whether anything differs in columns x0..x1-1 of rows y0..y1-1 (image coordinates; what lies outside the box does
  // not differ).
  bool differs(int x0, int y0, int x1, int y1) const;

private:
  Rect m_box;
  std::size_t m_wordsPerRow;
  std::vector<std::uint64_t> m_bits;
};

} // namespace parity::compare
