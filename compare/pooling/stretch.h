// Sums over a stretch of values: what pooling adds up of each run of pixels.
#pragma once

#include <cstddef>

namespace parity::compare {

// Values with their weights (null: all 1), at least one.
struct Stretch {
  const float *values, *weights;
  std::size_t count;
};

// Of values times weights, in double; the order of the additions depends on the count alone.
double sumOf(const Stretch& stretch);

struct Extremes {
  float min, max;
};
Extremes extremesOf(const Stretch& stretch);

// The weight of the values strictly above the threshold.
double weightAbove(const Stretch& stretch, float threshold);

} // namespace parity::compare
