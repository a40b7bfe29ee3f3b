#include "report/judge.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/glob.h"

namespace parity::report {
namespace {

void apply(const compare::BudgetRule* rule, const compare::Figures& figures, std::vector<compare::CheckResult>& checks,
           compare::AppliedRule& applied) {
  checks = rule ? compare::runChecks(*rule, figures) : std::vector<compare::CheckResult>{};
  applied = rule ? compare::appliedOf(*rule) : compare::AppliedRule{};
}

bool hasMaterial(const SceneResult& scene, const std::string& glob) {
  return std::ranges::any_of(scene.views, [&](const ViewResult& view) {
    return std::ranges::any_of(view.materials,
                               [&](const MaterialResult& each) { return base::matchesGlob(glob, each.name); });
  });
}

} // namespace

void judgeMaterial(MaterialResult& material, const compare::Budgets& budgets, std::string_view scene) {
  const compare::BudgetRule* rule = compare::findMaterialRule(budgets, scene, material.name);
  apply(rule, material.figures, material.checks, material.rule);
  for (WhatIf& each : material.whatIf) apply(rule, each.figures, each.checks, material.rule);
  settleMaterial(material, false);
}

void judgeWhole(ViewResult& view, const compare::Budgets& budgets, std::string_view scene) {
  apply(compare::findWholeRule(budgets, scene), view.whole, view.checks, view.rule);
}

void judgeScene(SceneResult& scene, const compare::Budgets& budgets) {
  for (ViewResult& view : scene.views) {
    for (MaterialResult& material : view.materials) judgeMaterial(material, budgets, scene.name);
    judgeWhole(view, budgets, scene.name);
  }
}

std::string describeUnusedRules(const compare::Budgets& budgets, const Report& report) {
  std::vector<compare::JudgedScene> scenes;
  for (const SceneResult& scene : report.scenes) {
    compare::JudgedScene& judged = scenes.emplace_back();
    judged.name = scene.name;
    judged.isError = !scene.error.empty();
    for (const ViewResult& view : scene.views) {
      judged.wholes.push_back(view.rule);
      for (const MaterialResult& material : view.materials) judged.materials.push_back(material.rule);
    }
  }
  return compare::describeUnusedRules(budgets, scenes);
}

std::vector<RunProblem> findLost(const compare::Budgets& budgets, const std::vector<const SceneResult*>& scenes) {
  std::vector<RunProblem> lost;
  for (const compare::BudgetRule& rule : budgets.materials) {
    if (!rule.requireSeen) continue;
    std::vector<std::string> names;
    bool isKnown = true; // what a scene has that could not be compared is not
    for (const SceneResult* scene : scenes) {
      if (!base::matchesGlob(rule.scene, scene->name)) continue;
      names.push_back(fmt::format("'{}'", scene->name));
      isKnown = isKnown && scene->error.empty() && !hasMaterial(*scene, rule.material);
    }
    if (names.empty() || !isKnown) continue;
    constexpr std::size_t kMostNamed = 3;
    const std::string where = names.size() == 1 ? "scene " + names[0] + " has"
                              : names.size() <= kMostNamed
                                  ? fmt::format("none of the scenes {} has", fmt::join(names, ", "))
                                  : fmt::format("none of {} scenes has", names.size());
    lost.push_back({compare::Verdict::fail,
                    fmt::format("{}: require_seen requires material '{}', but {} {}", rule.origin, rule.material, where,
                                names.size() == 1 ? "no such material" : "one"),
                    rule.file, rule.line});
  }
  return lost;
}

} // namespace parity::report
