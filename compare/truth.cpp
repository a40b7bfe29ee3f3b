#include "compare/truth.h"

namespace parity::compare {

const TruthRegion& mainRegion(const Truth& truth) {
  return truth.interior.highend.pixels > 0 ? truth.interior : truth.all;
}

bool isWithinNoise(const Figures& figures, const TruthError& error) {
  const std::optional<double> found = figures.find("relmse");
  return found && error.relmse > 0 && *found <= kFewStandardErrors * kFewStandardErrors * error.relmse;
}

} // namespace parity::compare
