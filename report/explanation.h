// Which approximations of the test path make a material differ, and what would help it (--explain over-budget).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parity::report {

// What one approximation adds to the material's mean FLIP: what a nearer form takes off.
struct ApproximationEffect {
  std::string approximation; // "SH order of the sky"
  std::string change;        // to the nearer form: "sky-sh=9"
  double alone = 0;          // mean FLIP that this change takes off by itself; below 0: it adds to it
  double share = 0;          // the same as a mean over all orders in which the changes can be made (Shapley value)
};

// Changes of the test path, made together.
struct ExplainedSet {
  std::vector<std::string> changes;         // empty: none
  double flip = 0;                          // mean FLIP of the material
  std::int64_t operations = 0, fetches = 0; // of one of its pixels
};

// The pixels of the material where a quantity lies between two values.
struct ErrorRange {
  std::string quantity;        // "roughness", "metallic", "N.V"
  double from = 0, to = 1;     // of the quantity
  double pixels = 0, flip = 0; // shares of its pixels and of its FLIP, in [0, 1]
};

// Where on a texture of the material its error lies.
struct ErrorMask {
  std::string input;   // of the material's card, whose texture the picture covers: "roughness"
  std::string picture; // PNG, relative to the report's folder: opaque where the texels make half of the FLIP
  double texels = 0;   // share of the texture's seen texels that it marks, in [0, 1]
};

struct Explanation {
  std::string words;                               // the approximation that makes most of it, and the advice, in a line
  std::string failure;                             // not empty: it could not be explained, this line says why
  std::vector<std::string> advice;                 // sentences; what they say was rendered
  std::vector<ApproximationEffect> approximations; // the largest share first
  std::vector<ExplainedSet> sets;                  // the best of each size, that of no change first
  std::size_t advised = 0;                         // place in `sets`; 0: none
  std::string picture;                             // crop of the test picture with the advised set; empty: none
  std::vector<ErrorRange> ranges;                  // of equal size, those that hold pixels, by quantity
  std::vector<ErrorMask> masks;                    // at most one
};

} // namespace parity::report
