#include "study/explain/search.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <nlopt.hpp>

namespace parity::explain {

namespace {

std::vector<double> wrapped(std::vector<double> at, const std::vector<bool>& periodic) {
  for (std::size_t i = 0; i < at.size(); ++i)
    at[i] = periodic[i] ? at[i] - std::floor(at[i]) : std::clamp(at[i], 0.0, 1.0);
  return at;
}

struct Ascent {
  const CostlyFunction& value;
  const std::vector<bool>& periodic;
  Peak best;
};

double climb(const std::vector<double>& at, std::vector<double>&, void* data) {
  Ascent& ascent = *static_cast<Ascent*>(data);
  const std::vector<double> place = wrapped(at, ascent.periodic);
  const double value = ascent.value(place);
  if (value > ascent.best.value) ascent.best = {place, value};
  return value;
}

} // namespace

std::vector<Peak> spreadPoints(const CostlyFunction& value, std::size_t dimensions, int count, int first) {
  double root = 1.5;
  for (int i = 0; i < 60; ++i) root = std::pow(1 + root, 1 / static_cast<double>(dimensions + 1));
  std::vector<Peak> points;
  for (int k = first + 1; k <= first + count; ++k) {
    std::vector<double> at;
    for (std::size_t i = 0; i < dimensions; ++i) {
      const double x = 0.5 + k * std::pow(root, -static_cast<double>(i + 1));
      at.push_back(x - std::floor(x));
    }
    points.push_back({at, value(at)});
  }
  return points;
}

double distanceOf(const std::vector<double>& a, const std::vector<double>& b, const std::vector<bool>& periodic) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double apart = std::abs(a[i] - b[i]);
    most = std::max(most, periodic[i] ? std::min(apart, 1 - apart) : apart);
  }
  return most;
}

Peak refine(const CostlyFunction& value, const std::vector<bool>& periodic, const Peak& from, int steps) {
  const std::size_t d = from.at.size();
  Ascent ascent{value, periodic, from};
  nlopt::opt subplex(nlopt::LN_SBPLX, static_cast<unsigned>(d));
  std::vector<double> low(d, 0), high(d, 1);
  for (std::size_t i = 0; i < d; ++i)
    if (periodic[i]) low[i] = from.at[i] - 0.5, high[i] = from.at[i] + 0.5;
  subplex.set_lower_bounds(low);
  subplex.set_upper_bounds(high);
  subplex.set_initial_step(0.04);
  subplex.set_max_objective(climb, &ascent);
  subplex.set_maxeval(steps);
  std::vector<double> at = from.at;
  double reached = 0;
  try {
    subplex.optimize(at, reached);
  } catch (const std::runtime_error&) { // it gets no further: the best so far counts
  }
  return ascent.best;
}

} // namespace parity::explain
