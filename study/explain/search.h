// The greatest value of a function that is costly, has many peaks and no slope: points spread evenly, the best refined.
#pragma once

#include <functional>
#include <vector>

namespace parity::explain {

// Over [0, 1]^d.
using CostlyFunction = std::function<double(const std::vector<double>&)>;

struct Peak {
  std::vector<double> at;
  double value = 0;
};

// So many points, an additive recurrence by the powers of the root of x^(d+1) = x + 1 (Roberts 2018, "The Unreasonable
// Effectiveness of Quasirandom Sequences"), in its order; from its place `first` on. dimensions >= 1.
std::vector<Peak> spreadPoints(const CostlyFunction& value, std::size_t dimensions, int count, int first = 0);

// Largest distance along an axis. periodic: of each dimension whether 0 and 1 are the same place.
double distanceOf(const std::vector<double>& a, const std::vector<double>& b, const std::vector<bool>& periodic);

// Climbs from a point by NLopt's subplex method (Rowan 1990), at most so many steps. Never below the start; periodic
// dimensions are wrapped. Deterministic.
Peak refine(const CostlyFunction& value, const std::vector<bool>& periodic, const Peak& from, int steps);

} // namespace parity::explain
