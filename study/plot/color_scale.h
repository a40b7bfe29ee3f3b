// Colours that stand for numbers.
#pragma once

#include <vector>

#include "study/plot/canvas.h"

namespace parity::plot {

// From low (its first colour) to high; what lies beyond takes the colour of its end, what is no number is green.
struct ColorScale {
  double low = 0, high = 1;
  bool isSigned = false; // about 0: blue below, red above, white at 0; else magma (compare/flip/magma.h)
  Rgb of(double value) const;
  // Round numbers along it, ends included.
  std::vector<double> ticks() const;
};

// Magma from 0 to the first round number (1, 2, 3, 4, 5, 6 or 8 of a decade) that is not below `most`.
ColorScale scaleUpTo(double most);
// Signed, as far to both sides.
ColorScale scaleAbout0(double most);

} // namespace parity::plot
