// Error figures of the fitted forms (see error_table.h).
#include "study/fit/error_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace parity::fit {

AlbedoError albedoError(const Truth& truth, const std::vector<Point>& points, const std::vector<double>& F0,
                        const LobeModel& model) {
  AlbedoError row{fmt::format("{}", fmt::join(F0, ", ")), 0, 0};
  double squares = 0;
  for (const Point& p : points)
    for (const double channel : F0) {
      const double exact = truth.total(p, channel);
      const double error = std::fabs(model(channel, p.roughness, p.NoV).total() - exact);
      squares += error * error;
      row.max = std::max(row.max, error);
    }
  row.rms = std::sqrt(squares / static_cast<double>(points.size() * F0.size()));
  return row;
}

std::vector<AlbedoError> albedoErrors(const Truth& truth, const LobeModel& model) {
  const std::vector<Point> points = truth.pointsOf(Domain::full, 96);
  std::vector<AlbedoError> rows;
  for (const std::vector<double>& F0 : std::vector<std::vector<double>>{{0.04}, {0.5}, {1}, {1, 0.71, 0.29}})
    rows.push_back(albedoError(truth, points, F0, model));
  return rows;
}

DirectError directError(const Truth& truth, const LobeModel& model) {
  const auto reflected = [&](const Point& p) {
    const LobeAlbedo albedo = model(1, p.roughness, p.NoV);
    const double single = truth.single(p, 1);
    if (truth.settings().compensation == Compensation::turquin) return single * albedo.total() / albedo.single;
    return single + albedo.multiple;
  };
  DirectError error{0, std::numeric_limits<double>::infinity(), 0, 0};
  const std::vector<Point> core = truth.pointsOf(Domain::core, 96);
  for (const Point& p : core) {
    const double ratio = reflected(p) / truth.total(p, 1);
    error.rmsLogRatio += std::pow(std::log(ratio), 2) / static_cast<double>(core.size());
    error.least = std::min(error.least, ratio);
    error.most = std::max(error.most, ratio);
  }
  error.rmsLogRatio = std::sqrt(error.rmsLogRatio);
  for (const Point& p : truth.pointsOf(Domain::full, 96)) error.exitanceMax = std::max(error.exitanceMax, reflected(p));
  return error;
}

} // namespace parity::fit
