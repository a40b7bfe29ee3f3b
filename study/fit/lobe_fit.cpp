// The specular lobe's constants by least squares (see lobe_fit.h).
#include "study/fit/lobe_fit.h"

#include <algorithm>
#include <cmath>

#include "study/fit/minimise.h"
#include "study/fit/refit_text.h"

namespace parity::fit {

namespace {

Unknowns toUnknowns(const LobeConstants& c) {
  Unknowns x(c.B.begin(), c.B.end());
  x.insert(x.end(), c.loss.begin(), c.loss.end());
  x.push_back(c.k);
  return x;
}

LobeConstants toConstants(const Unknowns& x) {
  LobeConstants c{};
  std::copy_n(x.begin(), 7, c.B.begin());
  // Below 0 the loss has a pole, maybe between the points that are fitted.
  std::transform(x.begin() + 7, x.begin() + 10, c.loss.begin(), [](double value) { return std::abs(value); });
  c.k = x[10];
  return c;
}

// What does not depend on F0.
struct Place {
  double B, loss, k;
};

Place placeOf(const LobeConstants& c, double R, double N) {
  const double alpha = std::max(R * R, 1.0 / 4096), t = N / alpha;
  const double B =
      std::exp2(R * (c.B[0] + R * (c.B[1] + c.B[2] * R)) + N * (c.B[3] + R * (c.B[4] + c.B[5] * R) + c.B[6] * N));
  return {B, N / (c.loss[0] + t * (c.loss[1] + c.loss[2] * t)), c.k * alpha};
}

LobeAlbedo albedoOf(const Place& place, Compensation compensation, double F0) {
  const double lost = F0 * place.loss;
  LobeAlbedo albedo{F0 - lost + (1 - F0) * place.B, 0};
  if (compensation != Compensation::none) albedo.multiple = lost * F0 * (1 - place.k * (1 - F0));
  return albedo;
}

} // namespace

LobeAlbedo evaluateLobe(const LobeConstants& c, Compensation compensation, double F0, double roughness, double NoV) {
  return albedoOf(placeOf(c, roughness, NoV), compensation, F0);
}

std::vector<LobeTarget> lobeTargetsOf(const Truth& truth) {
  std::vector<LobeTarget> targets;
  for (const Point& p : truth.pointsOf(Domain::full, 32)) {
    LobeTarget& target = targets.emplace_back(LobeTarget{p.roughness, p.NoV, {}, {}});
    for (std::size_t i = 0; i < kFittedF0.size(); ++i) {
      target.total[i] = truth.total(p, kFittedF0[i]);
      target.multiple[i] = truth.multiple(p, kFittedF0[i]);
    }
  }
  return targets;
}

double lobeObjective(const std::vector<LobeTarget>& targets, const LobeModel& model) {
  constexpr double kEven = 0.1;
  double sum = 0;
  for (const LobeTarget& target : targets)
    for (std::size_t i = 0; i < kFittedF0.size(); ++i) {
      const LobeAlbedo albedo = model(kFittedF0[i], target.roughness, target.NoV);
      const double error = albedo.total() - target.total[i], inMultiple = albedo.multiple - target.multiple[i];
      sum += error * error * (1 + kEven) / (target.total[i] + kEven);
      if (kFittedF0[i] >= 0.2) sum += 0.5 * inMultiple * inMultiple;
    }
  return sum / static_cast<double>(targets.size());
}

LobeConstants fitLobe(const Truth& truth) {
  const std::vector<LobeTarget> targets = lobeTargetsOf(truth);
  const Compensation compensation = truth.settings().compensation;
  const bool compensated = compensation != Compensation::none;
  const auto objective = [&](const Unknowns& x) {
    const LobeConstants c = toConstants(x);
    double R = -1, N = -1; // where `place` is
    Place place{};
    return lobeObjective(targets, [&](double F0, double roughness, double NoV) {
      if (roughness != R || NoV != N) place = placeOf(c, R = roughness, N = NoV);
      return albedoOf(place, compensation, F0);
    });
  };
  const LobeConstants start{{-1.6, -10.5, 7.4, -6.3, 14, -10, -8.6}, {0.5, 0.65, 0.4}, compensated ? 0.7 : 0};
  LobeConstants c = toConstants(minimise(objective, toUnknowns(start)).x);
  if (!compensated) c.k = 0;
  for (double& b : c.B) b = roundConstant(b);
  for (double& w : c.loss) w = roundConstant(w);
  c.k = roundConstant(c.k);
  return c;
}

} // namespace parity::fit
