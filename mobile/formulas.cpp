#include "mobile/formulas.h"

namespace parity::mobile {

namespace {

constexpr std::size_t kBuiltIn = static_cast<std::size_t>(EnvironmentBrdf::refit) + 1;

struct Added {
  std::vector<Options> presets;
  std::vector<Formula> formulas;
};

Added& added() {
  static Added all;
  return all;
}

} // namespace

bool addPreset(Options options, const Formula& formula) {
  options.environmentBrdf = static_cast<EnvironmentBrdf>(kBuiltIn + added().formulas.size());
  added().presets.push_back(std::move(options));
  added().formulas.push_back(formula);
  return true;
}

const std::vector<Options>& addedPresets() { return added().presets; }

const Formula* formulaOf(EnvironmentBrdf environmentBrdf) {
  const auto place = static_cast<std::size_t>(environmentBrdf);
  return place < kBuiltIn ? nullptr : &added().formulas.at(place - kBuiltIn);
}

} // namespace parity::mobile
