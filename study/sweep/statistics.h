// What repeated measurements say: medians, spreads, and whether two sets of them differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace parity::sweep {

// q in [0, 1], linear between neighbours in order (Hyndman and Fan 1996, type 7). values: not empty.
double quantileOf(std::vector<double> values, double q);

// Median and quartiles; all 0 for no values.
struct Spread {
  double median = 0, low = 0, high = 0;
};
Spread spreadOf(const std::vector<double>& values);

// after / before, of their medians, with the interval that holds it.
struct Ratio {
  double ratio = 1, low = 1, high = 1;
  bool isSlower() const { return low > 1; } // the interval leaves out 1
  bool isFaster() const { return high < 1; }
};

// The percentile bootstrap (Efron 1979): both sets are drawn again with replacement `draws` times. confidence in (0,
// 1), of this interval alone: who makes many of them divides the error by their number (Bonferroni). Deterministic for
// a seed. Two values a set at least; throws Error (usage) for fewer, and for a set that is not positive.
Ratio bootstrapRatio(const std::vector<double>& before, const std::vector<double>& after, double confidence,
                     std::size_t draws = 10000, std::uint32_t seed = 1);

// t = c n^k through points of n > 0, t > 0, by least squares of the logarithms. Two different n at least, else throws
// Error (usage).
struct PowerLaw {
  double exponent = 0, factor = 0;
};
PowerLaw fitPowerLaw(const std::vector<double>& n, const std::vector<double>& t);

} // namespace parity::sweep
