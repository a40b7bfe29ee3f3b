// By what a material is judged, as far as explanations need it.
#pragma once

#include <cstdint>
#include <string>

#include "compare/verdict/budget.h"

namespace parity::explain {

// Of the rule that judges the material: the lowest limit of its mean FLIP, warning before failing, the built-in one
// where it has none; and the pixels below which it is too small to be judged.
struct JudgedBy {
  double limit = 1;
  std::uint64_t leastPixels = compare::kDefaultMinPixels;
};
JudgedBy judgedBy(const compare::Budgets& budgets, const std::string& scene, const std::string& material);

} // namespace parity::explain
