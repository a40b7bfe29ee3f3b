// The minimum of a smooth function of a few variables, by NLopt.
#pragma once

#include <functional>
#include <vector>

namespace parity::fit {

using Unknowns = std::vector<double>;

struct Minimum {
  Unknowns x;
  double value;
};

// Descends from `start` by turns with sequential quadratic programming (Kraft 1994), L-BFGS (Nocedal 1980), both with
// central differences for slopes, and the subplex method (Rowan 1990), which needs none, until a turn gains less than a
// millionth. Deterministic: one thread, nothing random. A value that is not finite counts as 1e9. Never above f(start).
Minimum minimise(const std::function<double(const Unknowns&)>& f, Unknowns start);

} // namespace parity::fit
