// The one read's constants by what is displayed of a lamp (see tap_fit.h).
#include "study/fit/tap_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shading/shading.h"
#include "study/fit/minimise.h"
#include "study/fit/refit_text.h"

namespace parity::fit {

namespace {

namespace f64 = shading::f64;
using std::numbers::pi;
constexpr int kLastMip = f64::kPrefilterRoughestMip;

// The lamp: a Gaussian of so many radians, of these powers (radiance times solid angle), before this radiance. The fit
// hardly depends on them (docs/refit.md).
constexpr double kLampWidth = 0.06, kBackground = 0.03;
constexpr std::array kLampPowers = {0.01, 0.1, 1.0};

// Places of the lamp about the mirror direction: rings, dense near it, and azimuths of half of each.
constexpr int kRings = 18, kAzimuths = 8;

double show(double radiance) { return f64::linearToSrgb(std::clamp(radiance, 0.0, 1.0)); }

double lampDamping(int l) { return std::exp(-0.5 * l * (l + 1) * kLampWidth * kLampWidth); }

// The lamp through a lobe of N = V = R at some angle between both, per unit of power: the sum of its Legendre series.
double throughZonal(const Zonal& lobe, double angle) {
  const double c = std::cos(angle);
  double below = 1, at = c, sum = 1;
  for (int l = 1; l <= kBands; ++l) {
    sum += (2 * l + 1) * lobe[l] * lampDamping(l) * at;
    const double above = ((2 * l + 1) * c * at - l * below) / (l + 1);
    below = at;
    at = above;
  }
  return std::max(sum, 0.0) / (4 * pi);
}

// The lamp in a direction through a lobe, per unit of power.
double throughLobe(const Harmonics& lobe, const f64::real3& direction) {
  const Harmonics y = harmonicsAt(std::clamp(direction.z, -1.0, 1.0));
  const double azimuth = std::atan2(direction.y, direction.x);
  double sum = 0;
  for (int m = 0; m <= kBands; ++m) {
    const double cosine = std::cos(m * azimuth);
    for (int l = m; l <= kBands; ++l) sum += lobe[indexOf(l, m)] * lampDamping(l) * y[indexOf(l, m)] * cosine;
  }
  return std::max(sum, 0.0);
}

} // namespace

Tap evaluateTap(const TapConstants& c, double roughness, double NoV) {
  const double alpha = std::max(roughness * roughness, 1.0 / 4096);
  const double lean = alpha * (c.lean[0] + c.lean[1] * NoV);
  const double mip = c.mip[0] + c.mip[1] * std::log2(alpha) + c.mip[2] * NoV;
  return {1 / (1 + lean), mip, std::clamp(c.wide[0] * alpha + c.wide[1] + c.wide[2] * NoV, 0.0, 1.0)};
}

TapFit::TapFit(GeometryTerm term, const LobeSteps& steps) {
  base::parallelFor(m_mips.size(), 1, [&](std::size_t mip, std::size_t) {
    const Zonal lobe = dampingOf(f64::roughnessFromMip(static_cast<double>(mip)));
    for (int a = 0; a <= kAngles; ++a) m_mips[mip].push_back(throughZonal(lobe, pi * a / kAngles));
  });
  for (int i = 1; i <= 10; ++i)
    for (const double NoV : {.06, .15, .27, .4, .55, .7, .85, .97}) m_points.push_back({0.1 * i, NoV, NoV + 0.1, {}});
  std::vector<double> shown(m_points.size());
  base::parallelFor(m_points.size(), 1, [&](std::size_t i, std::size_t) {
    Point& p = m_points[i];
    const Harmonics lobe = projectLobe(term, p.roughness, p.NoV, steps);
    const double mirrored = std::acos(p.NoV);
    const double sinR = std::sin(mirrored), cosR = std::cos(mirrored);
    const auto angleOf = [](double ring) { return pi * ring * ring / (kRings * kRings); };
    for (int ring = 0; ring < kRings; ++ring)
      for (int a = 0; a < kAzimuths; ++a) {
        const double angle = angleOf(ring + 0.5), azimuth = pi * (a + 0.5) / kAzimuths;
        const double along = std::cos(angle), across = std::sin(angle) * std::cos(azimuth);
        const f64::real3 d(sinR * along + cosR * across, std::sin(angle) * std::sin(azimuth),
                           cosR * along - sinR * across);
        const double solidAngle = 2 * pi / kAzimuths * (std::cos(angleOf(ring)) - std::cos(angleOf(ring + 1)));
        Direction direction{d.x, d.z, solidAngle, std::max(d.z, 0.0) / pi, {}};
        const double seen = throughLobe(lobe, d);
        for (int k = 0; k < kPowers; ++k) {
          direction.shown[k] = show(kBackground + kLampPowers[k] * seen);
          shown[i] += p.weight * solidAngle * (direction.shown[k] - show(kBackground));
        }
        p.directions.push_back(direction);
      }
  });
  for (const double part : shown) m_shown += part;
}

double TapFit::errorAt(const Point& p, const Tap& tap) const {
  const double mip = std::clamp(tap.mip, 0.0, static_cast<double>(kLastMip));
  const int j = std::min(static_cast<int>(mip), kLastMip - 1);
  const double upper = (mip - j) * (1 - tap.wide), lower = 1 - tap.wide - upper;
  const double angle = angleOfBlend(p.NoV, tap.blend), x = std::sin(angle), z = std::cos(angle);
  double error = 0;
  for (const Direction& d : p.directions) {
    const double node = std::acos(std::clamp(x * d.x + z * d.z, -1.0, 1.0)) / pi * kAngles;
    const int a = std::min(static_cast<int>(node), kAngles - 1);
    const auto lobe = [&](int k) { return m_mips[k][a] + (m_mips[k][a + 1] - m_mips[k][a]) * (node - a); };
    const double seen = lower * lobe(j) + upper * lobe(j + 1) + tap.wide * d.cosine;
    for (int k = 0; k < kPowers; ++k)
      error += d.weight * std::abs(show(kBackground + kLampPowers[k] * seen) - d.shown[k]);
  }
  return error;
}

double TapFit::errorOf(const TapModel& model) const {
  std::vector<double> errors(m_points.size());
  base::parallelFor(m_points.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& p = m_points[i];
      errors[i] = p.weight * errorAt(p, model(p.roughness, p.NoV));
    }
  });
  double sum = 0;
  for (const double error : errors) sum += error;
  return sum / m_shown;
}

TapConstants TapFit::fit() const {
  const auto toConstants = [](const Unknowns& x) {
    return TapConstants{{x[0], x[1]}, {x[2], x[3], x[4]}, {x[5], x[6], x[7]}};
  };
  const Minimum best = minimise(
      [&](const Unknowns& x) {
        const TapConstants c = toConstants(x);
        return errorOf([&](double R, double N) { return evaluateTap(c, R, N); });
      },
      {1.5, -1.7, 4, 0.6, 1.1, 1.2, -0.07, -0.1});
  TapConstants c = toConstants(best.x);
  for (double& d : c.lean) d = roundConstant(d);
  for (double& m : c.mip) m = roundConstant(m);
  for (double& s : c.wide) s = roundConstant(s);
  return c;
}

} // namespace parity::fit
