// The figures of a comparison: what is measured of a region (a material, a mask or the whole image).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parity::compare {

// One pooled figure by the name that budgets, reports and tables use: "flip.mean", "flip.fraction_over(0.1)", "psnr",
// "bias.ev" (compare/pooling/statistic.h).
struct Figure {
  std::string name;
  double value = 0;
};

// What is known of one region: its pixels, weighted by how much of each it covers.
struct Figures {
  std::uint64_t pixels = 0;                  // in the region (weight > 0); all else is meaningless where this is 0
  std::uint64_t nonFinite = 0;               // pixels of the region where either image is NaN or infinite
  double clippedBlack = 0, clippedWhite = 0; // shares that are black in both displayed images, and white in both: there
                                             // the images say nothing, 0..1
  double referenceLuma = 0, testLuma = 0;    // mean Rec.709 luma of the displayed image, 0..1: says which is darker
  double referenceLuminance = 0, testLuminance = 0; // mean linear luminance as exposed, before clipping; 1: white
  std::vector<Figure> values;                       // of the metrics that were asked for, in the registry's order

  double clipped() const { return clippedBlack + clippedWhite; }
  // The figure of that name, if it was measured.
  std::optional<double> find(std::string_view name) const;
};

} // namespace parity::compare
