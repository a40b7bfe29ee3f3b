// Roots and powers of floats without tables, branches or calls, for loops that the compiler turns into vector code.
#pragma once

#include <bit>
#include <cstdint>

namespace parity::compare {

// Cube root of x in [1e-3, 2]. Relative error below 4e-7. No division: y approximates x^(-1/3), first on the bits of x
// (within 3.5 %), then by two steps y += y (r/3 + 2 r^2/9), r = 1 - x y^3, each of which leaves 14/81 r^3; the root is
// x y^2.
inline float fastCbrt(float x) {
  const float bits = static_cast<float>(std::bit_cast<std::int32_t>(x));
  float y = std::bit_cast<float>(static_cast<std::int32_t>(1419966092.f - bits * (1.f / 3.f)));
  for (int step = 0; step < 2; ++step) {
    const float r = 1.f - x * y * (y * y);
    y += y * r * (1.f / 3.f + r * (2.f / 9.f));
  }
  return x * (y * y);
}

// log2 of a positive normal x. Absolute error below 2e-7 + 6e-8 |log2 x|. x = 2^e m with m in [sqrt(1/2), sqrt(2));
// log2 m = 2/ln 2 atanh(s), s = (m-1)/(m+1), |s| < 0.172: the series up to s^9 leaves 2e-10.
inline float fastLog2(float x) {
  constexpr std::int32_t kSqrtHalf = 0x3f3504f3;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - kSqrtHalf) >> 23;
  const float m = std::bit_cast<float>(bits - exponent * (1 << 23));
  const float s = (m - 1.f) / (m + 1.f), s2 = s * s;
  const float series =
      2.885390082f + s2 * (0.961796694f + s2 * (0.577078016f + s2 * (0.412198583f + s2 * 0.320598898f)));
  return static_cast<float>(exponent) + s * series;
}

// 2^x for x in [-126, 126]. Relative error below 3e-7: the Taylor series of 2^f, |f| <= 1/2, up to f^6 leaves 1.3e-7.
inline float fastExp2(float x) {
  constexpr float kRound = 12582912.f; // 1.5 * 2^23: adding it rounds to an integer in the low bits
  const float whole = (x + kRound) - kRound, f = x - whole;
  const float series =
      1.f +
      f * (0.693147181f + f * (0.240226507f + f * (0.0555041087f +
                                                   f * (0.00961812911f + f * (0.00133335581f + f * 0.000154035304f)))));
  return std::bit_cast<float>(std::bit_cast<std::int32_t>(series) + static_cast<std::int32_t>(whole) * (1 << 23));
}

// x^e for x > 0 with |e log2 x| <= 126. Relative error below 4e-7 + 1.5e-7 |e log2 x|.
inline float fastPow(float x, float e) { return fastExp2(e * fastLog2(x)); }

} // namespace parity::compare
