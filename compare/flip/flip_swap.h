// LDR-FLIP of many pictures that each differ from one reference at the pixels of a list: the material swap's metric.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compare/flip/flip.h"
#include "compare/flip/flip_simd.h"
#include "compare/pooling/pixel_view.h"

namespace parity::compare {

// A picture that is the reference but at these pixels.
struct FlipSwap {
  std::span<const std::uint32_t> pixels; // y*width+x, ascending
  PixelView colors; // of those pixels, gathered (base/gathered.h); type and channels of the reference
};

// For each swap the FLIP values at its pixels, in their order: what flipMap gives for the whole picture there. The
// reference is decoded and filtered once for all swaps, and only near pixels of a swap that differ; so swaps of
// compact, disjoint regions cost together about what one picture costs. decoder: as flipMap for a default one; of
// HDR-FLIP one exposure. The result does not depend on the number of threads. Throws Error: notComparable for an empty
// reference or colours of another type or shape; usage for a ppd outside its range; failed for values that are not
// finite.
std::vector<std::vector<float>> flipSwaps(const PixelView& reference, std::span<const FlipSwap> swaps, float ppd,
                                          const RowDecoder& decoder = {});

} // namespace parity::compare
