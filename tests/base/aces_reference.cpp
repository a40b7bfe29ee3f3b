// The ACES 1.0.3 output transform, after the Academy's CTL sources: RRT.ctl, ACESlib.RRT_Common.ctl,
// ACESlib.Tonescales.ctl, ACESlib.ODT_Common.ctl, ODT.Academy.sRGB_100nits_dim.ctl. Matrices come from the primaries.
#include "aces_reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/glm.hpp>

namespace parity::base {

namespace {

using Vector = glm::dvec3;
using Matrix = glm::dmat3; // columns

Vector xyzOf(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

Matrix rgbToXyz(const Vector& red, const Vector& green, const Vector& blue, const Vector& white) {
  const Matrix primaries(red, green, blue);
  const Vector scale = glm::inverse(primaries) * white;
  return {red * scale.x, green * scale.y, blue * scale.z};
}

const Vector kD60 = xyzOf(0.32168, 0.33767), kD65 = xyzOf(0.3127, 0.3290);
const Matrix kAp0ToXyz = rgbToXyz(xyzOf(0.7347, 0.2653), xyzOf(0, 1), xyzOf(0.0001, -0.0770), kD60);
const Matrix kAp1ToXyz = rgbToXyz(xyzOf(0.713, 0.293), xyzOf(0.165, 0.830), xyzOf(0.128, 0.044), kD60);
const Matrix kRec709ToXyz = rgbToXyz(xyzOf(0.64, 0.33), xyzOf(0.30, 0.60), xyzOf(0.15, 0.06), kD65);

Matrix bradford(const Vector& from, const Vector& to) {
  const Matrix cone(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
  const Vector gain = (cone * to) / (cone * from);
  return glm::inverse(cone) * Matrix(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z) * cone;
}

double luminance(const Vector& ap1) { return (kAp1ToXyz * ap1).y; }

Vector desaturate(const Vector& ap1, double factor) { return factor * ap1 + (1 - factor) * Vector(luminance(ap1)); }

struct Point {
  double x, y;
};

// segmented_spline_c5_fwd and _c9_fwd: uniform quadratic B-splines in log10, with straight ends of given slope.
struct Tonescale {
  std::span<const double> low, high;
  Point min, mid, max;
  double slopeLow, slopeHigh;

  static double spline(std::span<const double> c, double position) {
    const auto j = static_cast<std::size_t>(position);
    const double t = position - static_cast<double>(j);
    return c[j] * (0.5 * t * t - t + 0.5) + c[j + 1] * (-t * t + t + 0.5) + c[j + 2] * 0.5 * t * t;
  }
  double operator()(double x) const {
    const double logX = std::log10(x > 0 ? x : std::exp2(-14));
    const double a = std::log10(min.x), b = std::log10(mid.x), c = std::log10(max.x);
    const auto intervals = static_cast<double>(low.size() - 3);
    double logY = 0;
    if (logX <= a)
      logY = slopeLow * (logX - a) + std::log10(min.y);
    else if (logX < b)
      logY = spline(low, intervals * (logX - a) / (b - a));
    else if (logX < c)
      logY = spline(high, intervals * (logX - b) / (c - b));
    else
      logY = slopeHigh * (logX - c) + std::log10(max.y);
    return std::pow(10, logY);
  }
};

double rrtTonescale(double x) {
  static constexpr double kLow[] = {-4, -4, -3.1573765773, -0.4852499958, 1.8477324706, 1.8477324706};
  static constexpr double kHigh[] = {-0.7185482425, 2.0810307172, 3.6681241237, 4, 4, 4};
  return Tonescale{kLow, kHigh, {0.18 * std::exp2(-15), 0.0001}, {0.18, 4.8}, {0.18 * std::exp2(18), 10000}, 0, 0}(x);
}

double odtTonescale48Nits(double x) {
  static constexpr double kLow[] = {-1.6989700043, -1.6989700043, -1.4779,      -1.2291,      -0.8648,
                                    -0.4480,       0.00518,       0.4511080334, 0.9113744414, 0.9113744414};
  static constexpr double kHigh[] = {0.5154386965, 0.8470437783, 1.1358,       1.3802,       1.5197,
                                     1.5985,       1.6467,       1.6746091357, 1.6878733390, 1.6878733390};
  return Tonescale{kLow,
                   kHigh,
                   {rrtTonescale(0.18 * std::exp2(-6.5)), 0.02},
                   {rrtTonescale(0.18), 4.8},
                   {rrtTonescale(0.18 * std::exp2(6.5)), 48},
                   0,
                   0.04}(x);
}

// The glow: dark saturated colours become up to 5 % brighter.
double glowGain(const Vector& c, double saturation) {
  constexpr double kGain = 0.05, kMid = 0.08, kChromaWeight = 1.75;
  const double chroma = std::sqrt(std::max(0.0, c.b * (c.b - c.g) + c.g * (c.g - c.r) + c.r * (c.r - c.b)));
  const double yc = (c.r + c.g + c.b + kChromaWeight * chroma) / 3;
  const double x = (saturation - 0.4) / 0.2, t = std::max(1 - std::abs(x / 2), 0.0);
  const double gain = kGain * (1 + (x < 0 ? -1 : 1) * (1 - t * t)) / 2;
  if (yc <= 2.0 / 3 * kMid) return 1 + gain;
  return yc >= 2 * kMid ? 1 : 1 + gain * (kMid / yc - 0.5);
}

// The red modifier's weight: 1.5 times a uniform cubic B-spline, 135 degrees wide around red.
double redWeight(const Vector& c) {
  if (c.r == c.g && c.g == c.b) return 0;
  const double hueDeg =
      std::atan2(std::numbers::sqrt3 * (c.g - c.b), 2 * c.r - c.g - c.b) * 180 / std::numbers::pi; // (-180,180]
  const double u = std::abs(hueDeg) * 4 / 135;
  if (u >= 2) return 0;
  return 1.5 * (u < 1 ? 2.0 / 3 - u * u + u * u * u / 2 : (2 - u) * (2 - u) * (2 - u) / 6);
}

} // namespace

std::array<double, 3> acesReference(const std::array<double, 3>& linear) {
  Vector aces = glm::inverse(kAp0ToXyz) * bradford(kD65, kD60) * kRec709ToXyz * Vector(linear[0], linear[1], linear[2]);
  const double highest = std::max({aces.r, aces.g, aces.b}), lowest = std::min({aces.r, aces.g, aces.b});
  const double saturation = (std::max(highest, 1e-10) - std::max(lowest, 1e-10)) / std::max(highest, 1e-2);
  aces *= glowGain(aces, saturation);
  aces.r += redWeight(aces) * saturation * (0.03 - aces.r) * (1 - 0.82);

  Vector ap1 = glm::max(glm::inverse(kAp1ToXyz) * kAp0ToXyz * glm::max(aces, 0.0), 0.0);
  ap1 = desaturate(ap1, 0.96);
  for (int i = 0; i < 3; ++i) {
    constexpr double kWhiteNits = 48, kBlackNits = 0.02;
    ap1[i] = (odtTonescale48Nits(rrtTonescale(ap1[i])) - kBlackNits) / (kWhiteNits - kBlackNits);
  }
  ap1 *= std::pow(std::max(luminance(ap1), 1e-10), 0.9811 - 1); // from dark to dim surround
  ap1 = desaturate(ap1, 0.93);

  const Vector shown = glm::inverse(kRec709ToXyz) * bradford(kD60, kD65) * kAp1ToXyz * ap1;
  std::array<double, 3> encoded{};
  for (int i = 0; i < 3; ++i) {
    const double v = std::clamp(shown[i], 0.0, 1.0);
    encoded[i] = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  }
  return encoded;
}

} // namespace parity::base
