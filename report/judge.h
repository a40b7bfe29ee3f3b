// Budgets applied to a report: who is judged by which rule, which rules judge nothing, and what is lost.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/verdict/budget.h"
#include "report/report.h"

namespace parity::report {

// Fills checks and rule by the first rule that matches, then verdict and reason by settleMaterial (as if no other view
// showed the material; settleVerdicts knows better).
void judgeMaterial(MaterialResult& material, const compare::Budgets& budgets, std::string_view scene);

// Fills the checks and the rule of the view's whole image. settleVerdicts sets the verdicts.
void judgeWhole(ViewResult& view, const compare::Budgets& budgets, std::string_view scene);

// Both for every view of the scene.
void judgeScene(SceneResult& scene, const compare::Budgets& budgets);

// The rules that judged nothing in this report, in a line (compare/verdict/budget.h).
std::string describeUnusedRules(const compare::Budgets& budgets, const Report& report);

// A failure for each rule with `require_seen` whose material none of the scenes has that the rule is for (at least one,
// all compared, with all of their materials): the asset has lost it, or the name is wrong.
std::vector<RunProblem> findLost(const compare::Budgets& budgets, const std::vector<const SceneResult*>& scenes);

} // namespace parity::report
