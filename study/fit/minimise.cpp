// Descent by turns with several of NLopt's methods (see minimise.h).
#include "study/fit/minimise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <nlopt.hpp>

namespace parity::fit {

namespace {

using Function = std::function<double(const Unknowns&)>;

double evaluate(const Unknowns& x, Unknowns& slope, void* data) {
  const Function& f = *static_cast<const Function*>(data);
  const auto at = [&](const Unknowns& y) {
    const double value = f(y);
    return std::isfinite(value) ? value : 1e9;
  };
  Unknowns y = x;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    const double step = 1e-5 * std::max(1.0, std::fabs(x[i]));
    y[i] = x[i] + step;
    const double above = at(y);
    y[i] = x[i] - step;
    slope[i] = (above - at(y)) / (2 * step);
    y[i] = x[i];
  }
  return at(x);
}

} // namespace

Minimum minimise(const Function& f, Unknowns start) {
  constexpr int kTurns = 12, kEvaluations = 400;
  Function function = f;
  Unknowns none;
  Minimum best{std::move(start), 0};
  best.value = evaluate(best.x, none, &function);
  for (int turn = 0; turn < kTurns; ++turn) {
    const double before = best.value;
    for (const nlopt::algorithm method : {nlopt::LD_SLSQP, nlopt::LD_LBFGS, nlopt::LN_SBPLX}) {
      nlopt::opt descent(method, static_cast<unsigned>(best.x.size()));
      descent.set_min_objective(evaluate, &function);
      descent.set_maxeval(method == nlopt::LN_SBPLX ? 8 * kEvaluations : kEvaluations);
      descent.set_ftol_rel(1e-9);
      Unknowns x = best.x;
      double value = best.value;
      try {
        descent.optimize(x, value);
      } catch (const std::runtime_error&) { // a line search that gets no further: x is where it stopped
      }
      value = evaluate(x, none, &function);
      if (value < best.value) best = {x, value};
    }
    if (before - best.value <= 1e-6 * before) break;
  }
  return best;
}

} // namespace parity::fit
