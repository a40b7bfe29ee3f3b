#include "study/plot/color_scale.h"

#include <algorithm>
#include <cmath>

#include "compare/flip/magma.h"

namespace parity::plot {

namespace {

// RdBu of eleven classes, from its blue end (C. Brewer 2002, colorbrewer2.org, Apache 2.0).
constexpr Rgb kBlueToRed[] = {{5, 48, 97},     {33, 102, 172},  {67, 147, 195},  {146, 197, 222},
                              {209, 229, 240}, {247, 247, 247}, {253, 219, 199}, {244, 165, 130},
                              {214, 96, 77},   {178, 24, 43},   {103, 0, 31}};
constexpr Rgb kNoNumber{0, 160, 60};

double roundUp(double most) {
  if (!(most > 0) || !std::isfinite(most)) return 1;
  const double decade = std::pow(10, std::floor(std::log10(most)));
  for (const double digit : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (most <= digit * decade * (1 + 1e-9)) return digit * decade;
  return 10 * decade;
}

} // namespace

Rgb ColorScale::of(double value) const {
  if (std::isnan(value)) return kNoNumber;
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  if (!isSigned) return compare::magmaColor(static_cast<int>(255 * share + 0.5));
  const double at = share * (std::size(kBlueToRed) - 1);
  const auto k = std::min(static_cast<std::size_t>(at), std::size(kBlueToRed) - 2);
  Rgb color;
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = static_cast<std::uint8_t>(
        std::lround(kBlueToRed[k][c] + (at - static_cast<double>(k)) * (kBlueToRed[k + 1][c] - kBlueToRed[k][c])));
  return color;
}

std::vector<double> ColorScale::ticks() const {
  std::vector<double> ticks;
  for (int k = 0; k <= 4; ++k) ticks.push_back(low + k * (high - low) / 4);
  return ticks;
}

ColorScale scaleUpTo(double most) { return {0, roundUp(most), false}; }
ColorScale scaleAbout0(double most) { return {-roundUp(most), roundUp(most), true}; }

} // namespace parity::plot
