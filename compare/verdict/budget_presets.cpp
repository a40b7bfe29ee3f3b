// The limits that come with the program: the default budgets and the named presets.
#include "compare/verdict/budget.h"

namespace parity::compare {
namespace {

BudgetCheck limit(const char* figure, std::optional<double> warn, double fail) {
  return {requireStatistic(figure, "built-in budgets"), warn, fail};
}

std::vector<BudgetCheck> limits(double flipMean, double flipP95, double biasEv) {
  return {limit("flip.mean", flipMean / 2, flipMean), limit("flip.p95", 0.6 * flipP95, flipP95),
          limit("bias.ev", biasEv / 2, biasEv)};
}

std::vector<BudgetPreset> makePresets() {
  return {
      {"default", "the built-in limits", limits(0.20, 0.50, 0.5), limits(0.16, 0.50, 0.5)},
      {"strict", "half of the built-in limits", limits(0.10, 0.25, 0.25), limits(0.08, 0.25, 0.25)},
      {"identical", "no pixel may differ", {limit("flip.max", std::nullopt, 0)}, {limit("flip.max", std::nullopt, 0)}}};
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
