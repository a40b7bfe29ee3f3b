// The one read's constants by least squares (see tap_fit.h).
#include "fit/tap_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "fit/minimise.h"
#include "fit/refit_text.h"
#include "shading/shading.h"

namespace parity::fit {

namespace {

namespace f64 = shading::f64;
constexpr double kPi = std::numbers::pi;
constexpr int kLastMip = f64::kPrefilterRoughestMip;

// Angles from the normal at which products are tabulated, linear between.
constexpr int kAngles = 400;
constexpr double kLeastAngle = -0.6, kMostAngle = kPi / 2 + 0.2;
double angleOfNode(int i) { return kLeastAngle + (kMostAngle - kLeastAngle) * i / (kAngles - 1); }

} // namespace

Tap evaluateTap(const TapConstants& c, double roughness, double NoV) {
  const double alpha = std::max(roughness * roughness, 1.0 / 4096);
  const double lean = alpha * (c.lean[0] + c.lean[1] * NoV + c.lean[2] * alpha * alpha);
  return {1 / (1 + lean), c.mip[0] + c.mip[1] * std::log2(alpha)};
}

TapFit::TapFit(GeometryTerm term, const LobeSteps& steps) {
  std::array<Zonal, kLastMip + 1> mips;
  for (int j = 0; j <= kLastMip; ++j) mips[j] = dampingOf(f64::roughnessFromMip(j));
  for (int j = 0; j <= kLastMip; ++j)
    for (int k = 0; k <= kLastMip; ++k) {
      m_between[j][k] = 0;
      for (int l = 1; l <= kBands; ++l)
        m_between[j][k] += mips[j][l] * mips[k][l] * naturalPower(l) * (2 * l + 1) / (4 * kPi);
    }
  for (int i = 2; i <= 20; ++i)
    for (const double NoV : {.04, .1, .18, .27, .37, .48, .6, .72, .84, .93, .99})
      m_points.push_back({0.05 * i, NoV, NoV + 0.1, 0, {}});
  std::vector<Harmonics> directions(kAngles);
  for (int a = 0; a < kAngles; ++a) directions[a] = harmonicsAt(std::cos(angleOfNode(a)));
  base::parallelFor(m_points.size(), 1, [&](std::size_t i, std::size_t) {
    Point& p = m_points[i];
    const Harmonics lobe = projectLobe(term, p.roughness, p.NoV, steps);
    p.products.resize(kAngles);
    for (int l = 1; l <= kBands; ++l) {
      for (int m = 0; m <= l; ++m) p.power += naturalPower(l) * lobe[indexOf(l, m)] * lobe[indexOf(l, m)];
      for (int a = 0; a < kAngles; ++a) {
        double product = 0;
        for (int m = 0; m <= l; ++m) // beyond the normal the azimuth is pi
          product += lobe[indexOf(l, m)] * directions[a][indexOf(l, m)] * (angleOfNode(a) < 0 && m % 2 == 1 ? -1 : 1);
        for (int j = 0; j <= kLastMip; ++j) p.products[a][j] += mips[j][l] * naturalPower(l) * product;
      }
    }
  });
}

double TapFit::squaredError(const Point& p, const Tap& tap) const {
  const double mip = std::clamp(tap.mip, 0.0, static_cast<double>(kLastMip));
  const int j = std::min(static_cast<int>(mip), kLastMip - 1);
  const double upper = mip - j, lower = 1 - upper;
  const double x = (angleOfBlend(p.NoV, tap.blend) - kLeastAngle) / (kMostAngle - kLeastAngle) * (kAngles - 1);
  const int a = std::clamp(static_cast<int>(x), 0, kAngles - 2);
  const auto product = [&](int k) { return p.products[a][k] + (p.products[a + 1][k] - p.products[a][k]) * (x - a); };
  return p.power - 2 * (lower * product(j) + upper * product(j + 1)) + lower * lower * m_between[j][j] +
         2 * lower * upper * m_between[j][j + 1] + upper * upper * m_between[j + 1][j + 1];
}

double TapFit::errorOf(const TapModel& model) const {
  double error = 0, power = 0;
  for (const Point& p : m_points) {
    error += p.weight * squaredError(p, model(p.roughness, p.NoV));
    power += p.weight * p.power;
  }
  return std::sqrt(error / power);
}

TapConstants TapFit::fit() const {
  const auto toConstants = [](const Unknowns& x) { return TapConstants{{x[0], x[1], x[2]}, {x[3], x[4]}}; };
  const Minimum best = minimise(
      [&](const Unknowns& x) {
        const TapConstants c = toConstants(x);
        return errorOf([&](double R, double N) { return evaluateTap(c, R, N); });
      },
      {1.4, -2, 7, 5, 0.6});
  TapConstants c = toConstants(best.x);
  for (double& d : c.lean) d = roundConstant(d);
  for (double& m : c.mip) m = roundConstant(m);
  return c;
}

} // namespace parity::fit
