// The limits that come with the program: the default budgets and the named presets.
#include "compare/budget.h"

namespace parity::compare {
namespace {

BudgetCheck limit(const char* figure, Region region, std::optional<double> warn, double fail) {
  return {requireStatistic(figure, "built-in budgets"), region, warn, fail};
}

std::vector<BudgetCheck> flipLimits(Region region, double mean, double p95) {
  return {limit("flip.mean", region, mean / 2, mean), limit("flip.p95", region, 0.6 * p95, p95)};
}

std::vector<BudgetPreset> makePresets() {
  return {
      {"default", "the built-in limits", flipLimits(Region::interior, 0.20, 0.50), flipLimits(Region::all, 0.16, 0.50)},
      {"strict", "half of the built-in limits", flipLimits(Region::interior, 0.10, 0.25),
       flipLimits(Region::all, 0.08, 0.25)},
      {"identical",
       "no pixel may differ",
       {limit("flip.max", Region::all, std::nullopt, 0)},
       {limit("flip.max", Region::all, std::nullopt, 0)}}};
}

Budgets makeDefaults() {
  const BudgetPreset& preset = builtInPresets().front();
  BudgetRule material, whole;
  material.origin = whole.origin = "built-in";
  material.preset = whole.preset = preset.name;
  material.checks = preset.materials;
  whole.checks = preset.wholes;
  return {{material}, {whole}};
}

} // namespace

const std::vector<BudgetPreset>& builtInPresets() {
  static const std::vector<BudgetPreset> presets = makePresets();
  return presets;
}

const Budgets& defaultBudgets() {
  static const Budgets budgets = makeDefaults();
  return budgets;
}

} // namespace parity::compare
