// One map of a figure: a quantity over N.V (to the right) and roughness (upwards) in colours, with axes, lines of equal
// value and the scale of the colours beside it.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "study/plot/color_scale.h"

namespace parity::plot {

struct Panel {
  double x = 0, y = 0, width = 360, height = 280;            // of the map itself, pixels
  std::string caption;                                       // above it
  std::function<double(double roughness, double NoV)> value; // both 0 to 1
  ColorScale scale;
  bool contours = false;                             // at the scale's ticks
  std::vector<std::pair<double, std::string>> marks; // roughness and a few letters: lines across the map
};

// To the right of a panel its scale takes so many pixels, its axes take so many to the left and below.
inline constexpr double kScaleWidth = 92, kAxisWidth = 58, kAxisHeight = 48;

void drawPanel(Canvas& canvas, const Panel& panel);

} // namespace parity::plot
