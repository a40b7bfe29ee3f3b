// By what a material is judged, as far as explanations need it.
#pragma once

#include <cstdint>
#include <string>

#include "compare/verdict/budget.h"

namespace parity::explain {

// limit: the lowest limit of the material's mean FLIP, warning before failing; of a rule that has none, the built-in
// one. leastPixels: a material of fewer is too small to be judged.
struct JudgedBy {
  double limit = 1;
  std::uint64_t leastPixels = compare::kDefaultMinPixels;
};
JudgedBy judgedBy(const compare::Budgets& budgets, const std::string& scene, const std::string& material);

} // namespace parity::explain
