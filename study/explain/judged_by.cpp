#include "study/explain/judged_by.h"

#include <algorithm>
#include <optional>

namespace parity::explain {

JudgedBy judgedBy(const compare::Budgets& budgets, const std::string& scene, const std::string& material) {
  JudgedBy by;
  if (const compare::BudgetRule* rule = compare::findMaterialRule(budgets, scene, material))
    by.leastPixels = rule->minPixels;
  for (const compare::Budgets* each : {&budgets, &compare::defaultBudgets()}) {
    std::optional<double> lowest;
    if (const compare::BudgetRule* rule = compare::findMaterialRule(*each, scene, material))
      for (const compare::BudgetCheck& check : rule->checks)
        if (check.statistic.name == "flip.mean") {
          const double limit = check.warn.value_or(check.fail.value_or(1));
          lowest = std::min(limit, lowest.value_or(limit));
        }
    if (lowest) {
      by.limit = *lowest;
      break;
    }
  }
  return by;
}

} // namespace parity::explain
