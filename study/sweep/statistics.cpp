#include "study/sweep/statistics.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"

namespace parity::sweep {

double quantileOf(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

Spread spreadOf(const std::vector<double>& values) {
  if (values.empty()) return {};
  return {quantileOf(values, 0.5), quantileOf(values, 0.25), quantileOf(values, 0.75)};
}

Ratio bootstrapRatio(const std::vector<double>& before, const std::vector<double>& after, double confidence,
                     std::size_t draws, std::uint32_t seed) {
  for (const auto* set : {&before, &after})
    if (set->size() < 2 || std::any_of(set->begin(), set->end(), [](double v) { return !(v > 0); }))
      throw base::Error(base::ExitCode::usage, "bench", "ratio", "both sides need at least two positive times");
  std::mt19937 random(seed);
  const auto medianOfDraw = [&](const std::vector<double>& set) {
    // Not uniform_int_distribution, whose numbers differ from library to library.
    std::vector<double> drawn(set.size());
    for (double& value : drawn) value = set[(std::uint64_t{random()} * set.size()) >> 32];
    return quantileOf(std::move(drawn), 0.5);
  };
  std::vector<double> ratios(draws);
  for (double& ratio : ratios) {
    const double a = medianOfDraw(after);
    ratio = a / medianOfDraw(before);
  }
  const double tail = 0.5 * (1 - confidence);
  return {quantileOf(after, 0.5) / quantileOf(before, 0.5), quantileOf(ratios, tail), quantileOf(ratios, 1 - tail)};
}

PowerLaw fitPowerLaw(const std::vector<double>& n, const std::vector<double>& t) {
  double sumX = 0, sumY = 0, sumXX = 0, sumXY = 0;
  const auto count = static_cast<double>(n.size());
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double x = std::log(n[i]), y = std::log(t[i]);
    sumX += x;
    sumY += y;
    sumXX += x * x;
    sumXY += x * y;
  }
  const double spread = count * sumXX - sumX * sumX;
  if (!(spread > 1e-9) || !std::isfinite(sumY))
    throw base::Error(base::ExitCode::usage, "bench", "exponent", "it needs positive times at two sizes or more");
  const double exponent = (count * sumXY - sumX * sumY) / spread;
  return {exponent, std::exp((sumY - exponent * sumX) / count)};
}

} // namespace parity::sweep
