#include "compare/metrics/ciede2000.h"

#include <cmath>

#include "compare/metrics/vector_math.h"

// Plain loops without branches: the compiler makes vectors of them for each instruction set that Highway names.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/ciede2000.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace parity::compare::HWY_NAMESPACE {

struct Direction {
  float c, s; // cosine, sine
};

// Of the angle between two hues, the shorter way round, and the sine of half their difference h2 - h1 with its sign, in
// terms of the chroma vectors: (a1, b1) of length c1, (a2, b2) of length c2. No angle is computed: where hues are less
// than 90 degrees apart their bisector is the sum of unit vectors, otherwise it stands upright on their difference;
// that keeps every digit also where hues are opposite.
struct Hues {
  Direction mean;
  float halfSine; // times sqrt(c1 c2)
};
inline Hues compareHues(float a1, float b1, float c1, float a2, float b2, float c2) {
  const float r1 = c1 > 0.f ? 1.f / c1 : 0.f, r2 = c2 > 0.f ? 1.f / c2 : 0.f;
  const float dot = a1 * a2 + b1 * b2, cross = a1 * b2 - a2 * b1, product = c1 * c2;
  // Of hues just opposite, h2 - h1 is -180 degrees where h1 is the greater (Sharma 2005, equation 10).
  const float opposite = b1 < 0.f || (b1 == 0.f && a1 < 0.f) ? -1.f : 1.f;
  const float sign = cross > 0.f ? 1.f : cross < 0.f ? -1.f : opposite;
  const bool near = dot >= 0.f;
  const float sumX = a1 * r1 + a2 * r2, sumY = b1 * r1 + b2 * r2;
  const float differenceX = sign * (b2 * r2 - b1 * r1), differenceY = sign * (a1 * r1 - a2 * r2);
  const float x = near ? sumX : differenceX, y = near ? sumY : differenceY;
  const float length = std::sqrt(x * x + y * y);
  // 2 sin^2(d/2) = 1 - cos d; for near hues, where that cancels, sin^2 d / (1 + cos d).
  const float nearSquare = 0.5f * cross * cross / (product + dot > 0.f ? product + dot : 1.f);
  const float farSquare = 0.5f * (product - dot);
  const float square = near ? nearSquare : farSquare;
  return {{length > 0.f ? x / length : 1.f, length > 0.f ? y / length : 0.f},
          sign * std::sqrt(square > 0.f ? square : 0.f)};
}

// The angle of a unit vector in degrees, 0..360. atan on [0,1] by Abramowitz and Stegun 1964, 4.4.49: within 2e-8.
inline float degreesOf(Direction d) {
  const float ax = std::fabs(d.c), ay = std::fabs(d.s);
  const float least = ax < ay ? ax : ay, most = ax < ay ? ay : ax;
  const float t = least / most, t2 = t * t;
  const float odd = -0.0752896400f + t2 * (0.0429096138f + t2 * (-0.0161657367f + t2 * 0.0028662257f));
  const float series =
      1.f + t2 * (-0.3333314528f + t2 * (0.1999355085f + t2 * (-0.1420889944f + t2 * (0.1065626393f + t2 * odd))));
  const float octant = t * series;
  constexpr float kHalfPi = 1.57079632679f, kPi = 3.14159265359f;
  const float quadrant = ax < ay ? kHalfPi - octant : octant;
  const float half = d.c < 0.f ? kPi - quadrant : quadrant;
  return (d.s < 0.f ? 2.f * kPi - half : half) * (180.f / kPi);
}

inline Direction rotate(Direction a, Direction b) { return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s}; }

inline float pow7(float x) {
  const float x2 = x * x;
  return x2 * x2 * x2 * x;
}

// sqrt(c^7 / (c^7 + 25^7)), of c/25 so that no power overflows a float.
inline float chromaWeight(float c) {
  const float c7 = pow7(c * (1.f / 25.f));
  return std::sqrt(c7 / (c7 + 1.f));
}

// Sine of x in [0, pi/3] by its series up to x^9: within 5e-8.
inline float sineOf(float x) {
  const float x2 = x * x;
  return x * (1.f + x2 * (-1.f / 6 + x2 * (1.f / 120 + x2 * (-1.f / 5040 + x2 * (1.f / 362880)))));
}

void Ciede2000(const LabRow& reference, const LabRow& test, int count, float* __restrict out) {
  // Cosines and sines of 30, 6 and 63 degrees, for the phases of T.
  constexpr Direction k30 = {0.866025404f, 0.5f}, k6 = {0.994521895f, 0.104528463f}, k63 = {0.453990500f, 0.891006524f};
  for (int i = 0; i < count; ++i) {
    const float l1 = reference.l[i], l2 = test.l[i], b1 = reference.b[i], b2 = test.b[i];
    const float rawA1 = reference.a[i], rawA2 = test.a[i];
    // Equations 2-7: a is stretched where chroma is low.
    const float meanC = 0.5f * (std::sqrt(rawA1 * rawA1 + b1 * b1) + std::sqrt(rawA2 * rawA2 + b2 * b2));
    const float stretch = 1.f + 0.5f * (1.f - chromaWeight(meanC));
    const float a1 = stretch * rawA1, a2 = stretch * rawA2;
    const float c1 = std::sqrt(a1 * a1 + b1 * b1), c2 = std::sqrt(a2 * a2 + b2 * b2);
    // Equations 8-14.
    const Hues hues = compareHues(a1, b1, c1, a2, b2, c2);
    const float dL = l2 - l1, dC = c2 - c1, dH = 2.f * hues.halfSine;
    // Equation 15, by the cosines of multiples of the mean hue.
    const Direction h = hues.mean, h2 = rotate(h, h), h3 = rotate(h2, h), h4 = rotate(h2, h2);
    const float t = 1.f - 0.17f * (h.c * k30.c + h.s * k30.s) + 0.24f * h2.c + 0.32f * (h3.c * k6.c - h3.s * k6.s) -
                    0.20f * (h4.c * k63.c + h4.s * k63.s);
    // Equations 16-21.
    const float fromBlue = (degreesOf(h) - 275.f) * (1.f / 25.f);
    const float exponent = -1.44269504f * fromBlue * fromBlue;
    const float rotationAngle = 60.f * 0.0174532925f * fastExp2(exponent > -100.f ? exponent : -100.f);
    const float averageC = 0.5f * (c1 + c2), fromGrey = 0.5f * (l1 + l2) - 50.f;
    const float rotation = -2.f * chromaWeight(averageC) * sineOf(rotationAngle);
    const float sL = 1.f + 0.015f * fromGrey * fromGrey / std::sqrt(20.f + fromGrey * fromGrey);
    const float sC = 1.f + 0.045f * averageC, sH = 1.f + 0.015f * averageC * t;
    const float l = dL / sL, c = dC / sC, hue = dH / sH;
    const float square = l * l + c * c + hue * hue + rotation * c * hue;
    out[i] = std::sqrt(square > 0.f ? square : 0.f);
  }
}

} // namespace parity::compare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace parity::compare {

HWY_EXPORT(Ciede2000);

void ciede2000Row(const LabRow& reference, const LabRow& test, int count, float* out) {
  HWY_DYNAMIC_DISPATCH(Ciede2000)(reference, test, count, out);
}

} // namespace parity::compare
#endif
