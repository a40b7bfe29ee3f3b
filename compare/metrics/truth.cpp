#include "compare/metrics/truth.h"

namespace parity::compare {

bool isWithinNoise(const Figures& figures, const TruthError& error) {
  const std::optional<double> found = figures.find("relmse");
  return found && error.relmse > 0 && *found <= kFewStandardErrors * kFewStandardErrors * error.relmse;
}

} // namespace parity::compare
