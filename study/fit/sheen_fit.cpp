// The albedo of the sheen, fitted to its table (see sheen_fit.h).
#include "study/fit/sheen_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/sheen_albedo.h"
#include "study/fit/minimise.h"

namespace parity::fit {

namespace {

// A place, with what does not depend on the constants.
struct SheenTarget {
  double albedo;
  SheenConstants terms;
};

SheenConstants termsAt(double sheenRoughness, double N) {
  const double r = std::max(sheenRoughness, 0.07), u = 1 / r, s = std::sqrt(N);
  return {1, u, r, r * r, s * u * u, s * u, s * r, N * u, N * u * u, N * N * u * u};
}

double shareOf(const SheenConstants& c, const SheenConstants& terms) {
  double exponent = 0;
  for (std::size_t t = 0; t < terms.size(); ++t) exponent += c[t] * terms[t];
  return std::min(std::exp2(std::min(exponent, 8.0)), 1.0);
}

std::vector<SheenTarget> makeTargets(const reference::SheenAlbedo& table, int steps) {
  std::vector<SheenTarget> targets;
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; k <= steps; ++k) {
      const double r = 0.07 + 0.93 * i / steps, N = 0.02 + 0.98 * k / steps;
      targets.push_back({table.shareAt(r, N), termsAt(r, N)});
    }
  return targets;
}

struct SheenErrors {
  double rms, mean8, max;
};
SheenErrors errorsOf(const std::vector<SheenTarget>& targets, const SheenConstants& c) {
  double squares = 0, eighths = 0, worst = 0;
  for (const SheenTarget& target : targets) {
    const double error = shareOf(c, target.terms) - target.albedo;
    squares += error * error;
    eighths += std::pow(error, 8);
    worst = std::max(worst, std::abs(error));
  }
  const auto count = static_cast<double>(targets.size());
  return {std::sqrt(squares / count), std::pow(eighths / count, 0.125), worst};
}

} // namespace

double evaluateSheen(const SheenConstants& c, double sheenRoughness, double NoV) {
  return shareOf(c, termsAt(sheenRoughness, NoV));
}

SheenFit fitSheen() {
  const reference::SheenAlbedo table;
  const std::vector<SheenTarget> coarse = makeTargets(table, 48);
  const auto objective = [&](const Unknowns& x) {
    SheenConstants c{};
    std::copy_n(x.begin(), c.size(), c.begin());
    const SheenErrors e = errorsOf(coarse, c);
    return e.rms * e.rms + 0.25 * e.mean8 * e.mean8;
  };
  // A least-squares fit of log2 E.
  const Unknowns best =
      minimise(objective, {-2.505, 0.6026, 3.1755, -1.1006, -0.1395, -0.6601, -0.9005, -0.9302, 0.3177, -0.465}).x;
  SheenFit fit{};
  std::transform(best.begin(), best.end(), fit.constants.begin(), [](double x) { return std::round(x * 1e4) / 1e4; });
  const SheenErrors e = errorsOf(makeTargets(table, 240), fit.constants);
  fit.rms = e.rms;
  fit.max = e.max;
  return fit;
}

} // namespace parity::fit
