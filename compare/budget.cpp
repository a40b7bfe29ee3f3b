// The built-in budgets, and figures judged by a budget's rule.
#include "compare/budget.h"

#include <algorithm>
#include <cmath>

#include "base/glob.h"

namespace parity::compare {
namespace {

Verdict judge(const BudgetCheck& check, double value) {
  if (std::isnan(value)) return Verdict::error;
  const bool lowerBound = check.metric == Metric::psnr;
  const auto beyond = [&](const std::optional<double>& limit) {
    return limit && (lowerBound ? value < *limit : value > *limit);
  };
  return beyond(check.fail) ? Verdict::fail : beyond(check.warn) ? Verdict::warn : Verdict::pass;
}

Budgets makeDefaults() {
  BudgetRule material;
  material.origin = "built-in";
  material.checks = {{Metric::flipMean, Region::interior, 0.10, 0.20}, {Metric::flipP95, Region::interior, 0.30, 0.50}};
  BudgetRule whole;
  whole.origin = "built-in";
  whole.checks = {{Metric::flipMean, Region::all, 0.08, 0.16}, {Metric::flipP95, Region::all, 0.30, 0.50}};
  return {{material}, {whole}};
}

} // namespace

std::string_view nameOf(Metric metric) { return kMetricNames[static_cast<std::size_t>(metric)]; }

std::optional<Metric> metricByName(std::string_view name) {
  const auto found = std::ranges::find(kMetricNames, name);
  if (found == kMetricNames.end()) return std::nullopt;
  return static_cast<Metric>(found - kMetricNames.begin());
}

std::string_view labelOf(Metric metric) {
  switch (metric) {
  case Metric::flipMean:
    return "mean FLIP";
  case Metric::flipP50:
    return "median FLIP";
  case Metric::flipP95:
    return "FLIP p95";
  case Metric::flipMax:
    return "largest FLIP";
  case Metric::rmse:
    return "RMSE";
  case Metric::psnr:
    return "PSNR";
  }
  return "";
}

double valueOf(const Figures& figures, Metric metric) {
  switch (metric) {
  case Metric::flipMean:
    return figures.flip.mean;
  case Metric::flipP50:
    return figures.flip.p50;
  case Metric::flipP95:
    return figures.flip.p95;
  case Metric::flipMax:
    return figures.flip.max;
  case Metric::rmse:
    return figures.rmse;
  case Metric::psnr:
    return figures.psnr;
  }
  return NAN; // judged as an error
}

std::string_view nameOf(Region region) { return kRegionNames[static_cast<std::size_t>(region)]; }

const Budgets& defaultBudgets() {
  static const Budgets budgets = makeDefaults();
  return budgets;
}

const BudgetRule* findMaterialRule(const Budgets& budgets, std::string_view scene, std::string_view material) {
  const auto rule = std::ranges::find_if(budgets.materials, [&](const BudgetRule& candidate) {
    return base::matchesGlob(candidate.material, material) && base::matchesGlob(candidate.scene, scene);
  });
  return rule == budgets.materials.end() ? nullptr : &*rule;
}

const BudgetRule* findWholeRule(const Budgets& budgets, std::string_view scene) {
  const auto rule = std::ranges::find_if(
      budgets.wholes, [&](const BudgetRule& candidate) { return base::matchesGlob(candidate.scene, scene); });
  return rule == budgets.wholes.end() ? nullptr : &*rule;
}

std::vector<CheckResult> runChecks(const BudgetRule& rule, const RegionFigures& figures) {
  std::vector<CheckResult> results;
  if (figures.all.pixels == 0) return results;
  for (const BudgetCheck& check : rule.checks) {
    CheckResult result;
    const bool fallsBack = check.region == Region::interior && figures.interior.pixels == 0;
    const Region region = fallsBack ? Region::all : check.region;
    if (fallsBack) result.note = "no interior pixels: all pixels instead";
    result.metric = nameOf(check.metric);
    result.region = nameOf(region);
    result.value = valueOf(region == Region::all ? figures.all : figures.interior, check.metric);
    result.warnAbove = check.warn;
    result.failAbove = check.fail;
    result.verdict = judge(check, result.value);
    results.push_back(std::move(result));
  }
  return results;
}

void judgeMaterial(MaterialResult& material, const Budgets& budgets, std::string_view scene) {
  const BudgetRule* rule = findMaterialRule(budgets, scene, material.name);
  material.checks = rule ? runChecks(*rule, material.figures) : std::vector<CheckResult>{};
  material.budget = rule ? rule->origin : "";
  material.budgetReason = rule ? rule->reason : "";
  material.owner = rule ? rule->owner : "";
  material.requireSeen = rule && rule->requireSeen;
  settleMaterial(material, false);
}

void judgeWhole(ViewResult& view, const Budgets& budgets, std::string_view scene) {
  const BudgetRule* rule = findWholeRule(budgets, scene);
  view.checks = rule ? runChecks(*rule, view.whole) : std::vector<CheckResult>{};
}

} // namespace parity::compare
