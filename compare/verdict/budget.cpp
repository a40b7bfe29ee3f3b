// Figures judged by a budget's rule, and which rule that is.
#include "compare/verdict/budget.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/glob.h"

namespace parity::compare {
namespace {

// A check on the figure's own level; of a regression only what it would look at.
CheckResult prepareCheck(const BudgetCheck& check, const Figures& figures) {
  CheckResult result;
  result.metric = check.statistic.name;
  result.warnAbove = check.warn;
  result.failAbove = check.fail;
  const std::optional<double> value = figures.find(check.statistic.name);
  result.value = value.value_or(NAN);
  if (!value) result.note = "not measured";
  return result;
}

bool isOf(const AppliedRule& applied, const BudgetRule& rule) {
  return applied.line == rule.line && applied.file == rule.file;
}

// Whether the rule judged something, or could have in a scene that was not compared.
bool isUsed(const BudgetRule& rule, bool ofWholes, const std::vector<JudgedScene>& scenes) {
  return std::ranges::any_of(scenes, [&](const JudgedScene& scene) {
    if (scene.isError && base::matchesGlob(rule.scene, scene.name)) return true;
    return std::ranges::any_of(ofWholes ? scene.wholes : scene.materials,
                               [&](const AppliedRule& applied) { return isOf(applied, rule); });
  });
}

} // namespace

AppliedRule appliedOf(const BudgetRule& rule) {
  return {rule.origin, rule.reason, rule.owner,  rule.requireSeen, rule.minPixels,
          rule.file,   rule.line,   rule.preset, rule.accept,      rule.maxNonFinite};
}

std::string describeTooDark(std::string_view metric, const Figures& figures) {
  const double brighter = std::max(figures.referenceLuminance, figures.testLuminance);
  if (metric != "bias.ev" || !(brighter < kLeastLuminance)) return {};
  return fmt::format(
      "mean luminance is below {:g} in both pictures, which is too dark to measure a difference of exposure",
      kLeastLuminance);
}

std::vector<std::string> requiredStatistics(const Budgets& budgets) {
  std::vector<std::string> names;
  for (const std::vector<BudgetRule>* rules : {&budgets.materials, &budgets.wholes})
    for (const BudgetRule& rule : *rules)
      for (const std::vector<BudgetCheck>* checks : {&rule.checks, &rule.regress})
        for (const BudgetCheck& check : *checks)
          if (std::ranges::find(names, check.statistic.name) == names.end()) names.push_back(check.statistic.name);
  return names;
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

Verdict judgeLevel(Better better, double value, const std::optional<double>& warn, const std::optional<double>& fail) {
  if (std::isnan(value)) return Verdict::error;
  const auto beyond = [&](const std::optional<double>& limit) {
    if (!limit) return false;
    if (better == Better::higher) return value < *limit;
    return (better == Better::nearZero ? std::abs(value) : value) > *limit;
  };
  return beyond(fail) ? Verdict::fail : beyond(warn) ? Verdict::warn : Verdict::pass;
}

std::vector<CheckResult> runChecks(const BudgetRule& rule, const Figures& figures) {
  std::vector<CheckResult> results;
  if (figures.pixels == 0) return results;
  for (const BudgetCheck& check : rule.checks) {
    CheckResult result = prepareCheck(check, figures);
    result.unjudged = std::isnan(result.value) ? "" : describeTooDark(check.statistic.name, figures);
    result.verdict = result.judged() ? judgeLevel(check.statistic.better, result.value, check.warn, check.fail)
                                     : Verdict::warn; // where nothing else judges
    results.push_back(std::move(result));
  }
  for (const BudgetCheck& check : rule.regress) {
    CheckResult result = prepareCheck(check, figures);
    result.regress = true;
    result.verdict = Verdict::error; // what it is worth where nothing else judges
    // A figure that is not known cannot be judged whatever the baseline says: that is an error already.
    if (!std::isnan(result.value)) result.unjudged = figures.nonFinite > 0 ? kNonFinitePixels : "no baseline";
    result.value = NAN;
    results.push_back(std::move(result));
  }
  return results;
}

std::string describeUnusedRules(const Budgets& budgets, const std::vector<JudgedScene>& scenes) {
  std::vector<std::string> places;
  std::string file;
  const auto collect = [&](const std::vector<BudgetRule>& rules, bool ofWholes) {
    for (const BudgetRule& rule : rules) {
      if (rule.line == 0 || isUsed(rule, ofWholes, scenes)) continue;
      file = std::filesystem::path(rule.file).filename().string();
      const std::string scene = rule.scene == "*" ? "" : fmt::format(" of scenes '{}'", rule.scene);
      places.push_back(ofWholes ? fmt::format("line {} (whole images{})", rule.line, scene)
                                : fmt::format("line {} ('{}'{})", rule.line, rule.material, scene));
    }
  };
  collect(budgets.materials, false);
  collect(budgets.wholes, true);
  if (places.empty()) return {};
  return fmt::format("{}: {} nothing in this run: {}", file,
                     places.size() == 1 ? "a rule judges" : fmt::format("{} rules judge", places.size()),
                     fmt::join(places, ", "));
}

} // namespace parity::compare
