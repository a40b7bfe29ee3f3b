// FLIP's filters over one row: a window of rows comes in, the filtered row goes out.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "compare/flip_filters.h"

namespace parity::compare {

// Rows are worked on in steps of this many pixels; buffers are padded to it.
inline constexpr int kRowStep = 8;

// Pixels to allocate for a row of `width` output pixels and a margin of `radius` on either side.
int paddedRow(int width, int radius);

// One row of an image, filtered in both directions; `width` values each (more are allocated, to be ignored).
struct FilteredRow {
  std::vector<float> y, cx, cz;   // YCxCz seen through the contrast sensitivity functions
  std::vector<float> edge, point; // magnitudes of the edge and point filters over Y, in units of Y
};

// Filters rows of at most `width` pixels. The direction across rows comes first: it reads three planes and makes seven,
// so that the rows kept in the window are the three. (Replicated borders commute with separable filters.)
class RowFilter {
public:
  RowFilter(const FlipFilters& filters, int width);

  // Each pointer list has 2*radius + 1 rows of YCxCz, from the topmost; each row paddedRow(width, radius) finite values
  // that begin `radius` pixels left of the first output pixel.
  const FilteredRow& apply(const float* const* y, const float* const* cx, const float* const* cz);

private:
  enum Plane { luma, redGreen, blueYellowA, blueYellowB, gauss, edge, point, planeCount };

  void filterAcrossRows(const float* const* y, const float* const* cx, const float* const* cz);
  void filterAlongRow();

  const FlipFilters& m_filters;
  int m_width;
  std::array<std::vector<float>, planeCount> m_planes;
  FilteredRow m_out;
};

} // namespace parity::compare
