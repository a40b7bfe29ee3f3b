// Every function of shading/*.glsl on one row of numbers, on the CPU in each precision.
#pragma once

#include <array>

#include "study/stress/shaders/function_ids.glsl"

namespace parity::stress {

using Row = std::array<double, kInputs>;
using Result = std::array<double, kOutputs>;

enum class Precision { f64, f32, f16 };
inline constexpr std::array<Precision, 3> kPrecisions = {Precision::f64, Precision::f32, Precision::f16};

// "fp64", "fp32", "fp16".
const char* nameOf(Precision precision);

// The CPU's result at a precision. evaluate16 and evaluate32 round the row to their precision first.
Result evaluate64(int id, const Row& row);
Result evaluate32(int id, const Row& row);
Result evaluate16(int id, const Row& row);

// The same for rows whose numbers are floats already (all but f64): what the function itself holds in half it rounds
// to half, what it holds in at least single (real32) stays.
Result evaluateRounded(Precision precision, int id, const Row& row);

// Rounds every input to the nearest half, so that each precision gets the same numbers.
Row roundToHalf(const Row& row);

// Stored mantissa bits, exponent of the smallest normal number, smallest normal and largest finite number.
struct Format {
  int mantissaBits, minExponent;
  double smallestNormal, largest;
};
Format formatOf(Precision precision);

// |actual - expected| in units in the last place of max(|expected|, scale), for a format of `mantissaBits` stored bits
// and `minExponent` as the exponent of its smallest normal number. 0 for equal values, equal infinities and two NaN.
double ulpDistance(double actual, double expected, double scale, int mantissaBits, int minExponent);

inline constexpr int kMantissa32 = 23, kMinExponent32 = -126;
inline constexpr int kMantissa16 = 10, kMinExponent16 = -14;

} // namespace parity::stress
