// The specular lobe's constants by least squares (see lobe_fit.h).
#include "fit/lobe_fit.h"

#include <algorithm>
#include <cmath>

#include "fit/minimise.h"
#include "fit/refit_text.h"

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
  std::copy_n(x.begin() + 7, 3, c.loss.begin());
  c.k = x[10];
  return c;
}

} // namespace

LobeAlbedo evaluateLobe(const LobeConstants& c, Compensation compensation, double F0, double R, double N) {
  const double alpha = std::max(R * R, 1.0 / 4096), t = N / std::max(alpha, 1.0 / 256);
  const double B =
      std::exp2(R * (c.B[0] + R * (c.B[1] + c.B[2] * R)) + N * (c.B[3] + R * (c.B[4] + c.B[5] * R) + c.B[6] * N));
  const double lost = F0 * N / (c.loss[0] + t * (c.loss[1] + c.loss[2] * t));
  LobeAlbedo albedo{F0 - lost + (1 - F0) * B, 0};
  if (compensation != Compensation::none) albedo.multiple = lost * F0 * (1 - c.k * alpha * (1 - F0));
  return albedo;
}

double lobeObjective(const Truth& truth, const std::vector<Point>& points, const LobeModel& model) {
  constexpr double kEven = 0.1;
  double sum = 0;
  for (const Point& p : points)
    for (const double F0 : {0.02, 0.04, 0.08, 0.2, 0.4, 0.6, 0.8, 1.0}) {
      const double multiple = truth.multiple(p, F0), total = truth.single(p, F0) + multiple;
      const LobeAlbedo albedo = model(F0, p.roughness, p.NoV);
      const double error = albedo.total() - total, inMultiple = albedo.multiple - multiple;
      sum += error * error * (1 + kEven) / (total + kEven);
      if (F0 >= 0.2) sum += 0.5 * inMultiple * inMultiple;
    }
  return sum / static_cast<double>(points.size());
}

std::vector<Point> lobePointsOf(const Truth& truth) { return truth.pointsOf(Domain::full, 32); }

LobeConstants fitLobe(const Truth& truth) {
  const std::vector<Point> points = lobePointsOf(truth);
  const Compensation compensation = truth.settings().compensation;
  const bool compensated = compensation != Compensation::none;
  const auto objective = [&](const Unknowns& x) {
    const LobeConstants c = toConstants(x);
    return lobeObjective(truth, points,
                         [&](double F0, double R, double N) { return evaluateLobe(c, compensation, F0, R, N); });
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
