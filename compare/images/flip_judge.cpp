#include "compare/images/flip_judge.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "compare/images/flip_checks.h"
#include "compare/verdict/wording.h"

namespace parity::compare {

namespace {

// The rule that judges the row. A region is to its pair what a material is to its scene.
BudgetRule findRule(const FlipRow& row, const Budgets& budgets, const std::string& scene) {
  const BudgetRule* rule = row.whole ? findWholeRule(budgets, scene) : findMaterialRule(budgets, scene, row.name);
  if (!rule) throw base::Error(base::ExitCode::failed, "budgets", row.name, "no rule applies to it");
  return *rule;
}

} // namespace

void judgeRow(FlipRow& row, const FlipRequest& request, const std::vector<BudgetCheck>& limits,
              const std::string& scene) {
  BudgetRule own;
  own.checks = limits;
  row.checks = runChecks(own, row.figures);
  bool isAccepted = false; // its NaN and infinite pixels are
  if (request.budgets) {
    BudgetRule rule = findRule(row, *request.budgets, scene);
    if (row.name.starts_with("alpha")) rule.checks = checksOfAlpha(rule.checks);
    row.rule = appliedOf(rule);
    isAccepted = row.figures.nonFinite > 0 && row.figures.nonFinite <= rule.maxNonFinite.value_or(0);
    if (!isAccepted) // their figures hold the worst value there
      for (CheckResult& check : runChecks(rule, row.figures)) row.checks.push_back(std::move(check));
  }
  for (const CheckResult& check : row.checks)
    if (check.judged() && check.verdict > row.verdict) {
      row.verdict = check.verdict;
      row.reason = describeCheck(check);
    }
  const bool asked = !request.thresholds.empty() || request.budgets;
  const bool needsNone = isAccepted || (row.checks.empty() && row.rule.accepts(Accept::noLimit));
  if (asked && !needsNone && std::ranges::none_of(row.checks, &CheckResult::judged)) {
    row.verdict = Verdict::error;
    row.reason = row.checks.empty() ? "no limit applies to it"
                                    : "its budget has only regressions, but there is no baseline for them";
  }
  if (row.figures.nonFinite > 0 && !isAccepted && row.verdict < Verdict::fail) {
    row.verdict = Verdict::fail;
    row.reason =
        fmt::format("{} pixel{} NaN or infinite", row.figures.nonFinite, row.figures.nonFinite == 1 ? " is" : "s are");
  }
}

void settlePair(FlipPair& pair) {
  for (const FlipRow& row : pair.rows)
    if (row.verdict > pair.verdict) {
      pair.verdict = row.verdict;
      pair.reason = pair.rows.size() > 1 ? row.name + ": " + row.reason : row.reason;
    }
  for (const FlipRow& row : pair.rows)
    if (!row.rule.accept.empty() && row.verdict == Verdict::pass && (row.figures.nonFinite > 0 || row.checks.empty()))
      pair.notes.push_back(fmt::format("{}: accepted: {} (reason: {})", row.name,
                                       row.figures.nonFinite > 0
                                           ? fmt::format("{} pixels are NaN or infinite", row.figures.nonFinite)
                                           : std::string("no limit judges it"),
                                       row.rule.reason));
  const auto unjudged = [](const FlipRow& row) { return !std::ranges::all_of(row.checks, &CheckResult::judged); };
  if (std::ranges::any_of(pair.rows, unjudged))
    pair.notes.emplace_back("the regressions of the budgets are not judged, because there is no baseline");
}

} // namespace parity::compare
