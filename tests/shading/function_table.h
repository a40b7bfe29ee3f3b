// Every function of shading/*.glsl with the rows it is tried on and how closely device and CPU agree on it.
#pragma once

#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "shading/function_ids.glsl"

namespace parity::tests {

using Row = std::array<double, kInputs>;
using Result = std::array<double, kOutputs>;
using Random = std::mt19937;

// Agreement of the device with the CPU at equal precision, in units of the last place of max(|expected|, scale).
struct Agreement {
  double ulps32 = 0;
  double ulps16 = 0;
  double scale = 0;        // size of what cancels: an error of an operand shows as an error of the difference
  const char* reason = ""; // why not 0 ulp; empty where it is
};

struct FunctionCase {
  const char* name;
  int id;
  std::function<Row(Random&)> makeRow;
  Agreement agreement;
};

// One entry per id, in order.
std::vector<FunctionCase> functionTable();

// The CPU's result at a precision. evaluate16 and evaluate32 round the row to their precision first.
Result evaluate64(int id, const Row& row);
Result evaluate32(int id, const Row& row);
Result evaluate16(int id, const Row& row);

// Rounds every input to the nearest half, so that each precision gets the same numbers.
Row roundToHalf(const Row& row);

// |actual - expected| in units in the last place of max(|expected|, scale), for a format of `mantissaBits` stored bits
// and `minExponent` as the exponent of its smallest normal number. 0 for equal values, equal infinities and two NaN.
double ulpDistance(double actual, double expected, double scale, int mantissaBits, int minExponent);

inline constexpr int kMantissa32 = 23, kMinExponent32 = -126;
inline constexpr int kMantissa16 = 10, kMinExponent16 = -14;

} // namespace parity::tests
