// A budget file in words: which rules it makes, with the limits that presets put into them.
#include <fmt/format.h>

#include "base/text/text.h"
#include "compare/verdict/budget.h"
#include "compare/verdict/wording.h"

namespace parity::compare {
namespace {

std::string describeLimits(const BudgetCheck& check, bool regress) {
  CheckResult limits;
  limits.metric = check.statistic.name;
  limits.regress = regress;
  std::string words;
  if (check.warn) words += "warn " + formatLimit(limits, *check.warn);
  if (check.fail) words += (words.empty() ? "fail " : ", fail ") + formatLimit(limits, *check.fail);
  return fmt::format("    {}{} ({}): {}\n", regress ? "regression of " : "", check.statistic.label,
                     check.statistic.name, words);
}

std::string describeRule(const BudgetRule& rule, const std::string& subject) {
  std::string text = fmt::format("{}: {}", base::plainLine(rule.origin), subject);
  if (rule.scene != "*") text += fmt::format(" of scenes '{}'", base::plainLine(rule.scene));
  if (rule.requireSeen) text += ", must be visible in a view";
  if (rule.minPixels != kDefaultMinPixels) text += fmt::format(", at least {} pixels", rule.minPixels);
  if (!rule.owner.empty()) text += ", owner " + base::plainLine(rule.owner);
  if (!rule.reason.empty()) text += ": " + base::plainLine(rule.reason);
  text += "\n";
  for (const Accept each : rule.accept)
    text +=
        fmt::format("    accepts: {}{}\n", nameOf(each),
                    each == Accept::nonFinite ? fmt::format(", at most {} pixels in a view", *rule.maxNonFinite) : "");
  for (const BudgetCheck& check : rule.checks) text += describeLimits(check, false);
  for (const BudgetCheck& check : rule.regress) text += describeLimits(check, true);
  return text;
}

} // namespace

std::string describeBudgets(const Budgets& budgets) {
  std::string text;
  for (const BudgetRule& rule : budgets.materials)
    text += describeRule(rule,
                         rule.material == "*" ? "all materials" : "materials '" + base::plainLine(rule.material) + "'");
  for (const BudgetRule& rule : budgets.wholes) text += describeRule(rule, "whole images");
  return text;
}

} // namespace parity::compare
