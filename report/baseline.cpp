// Counterparts by name, the changes between them, and what has none.
#include "report/baseline.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/glob.h"
#include "compare/pooling/statistic.h"
#include "compare/verdict/budget.h"
#include "report/view_choice.h"

namespace parity::report {
namespace {

template <typename Named> const Named* findByName(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &Named::name);
  return found == list.end() ? nullptr : &*found;
}

// The scenes of a report by their names; of namesakes the first. The report must outlive it.
class ScenesByName {
public:
  explicit ScenesByName(const std::vector<SceneResult>& scenes) {
    for (const SceneResult& scene : scenes) m_scenes.emplace(scene.name, &scene);
  }
  const SceneResult* find(const std::string& name) const {
    const auto found = m_scenes.find(name);
    return found == m_scenes.end() ? nullptr : found->second;
  }

private:
  std::unordered_map<std::string_view, const SceneResult*> m_scenes;
};

// The material of that name which has as many namesakes before it; null if there is none.
const MaterialResult* findNamesake(const std::vector<MaterialResult>& list, const std::vector<MaterialResult>& own,
                                   std::size_t index) {
  const std::string& name = own[index].name;
  auto before =
      std::ranges::count(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(index), name, &MaterialResult::name);
  for (const MaterialResult& material : list)
    if (material.name == name && before-- == 0) return &material;
  return nullptr;
}

std::vector<FigureChange> changesOf(const compare::Figures& before, const compare::Figures& now) {
  std::vector<FigureChange> changes;
  if (before.pixels == 0 || now.pixels == 0 || before.nonFinite > 0) return changes;
  changes.reserve(now.values.size());
  for (const compare::Figure& figure : now.values)
    if (const std::optional<double> then = before.find(figure.name))
      changes.push_back({figure.name, *then, figure.value});
  return changes;
}

double worseBy(compare::Better better, double before, double now) {
  if (before == now) return 0; // also of infinities
  switch (better) {
  case compare::Better::lower:
    return now - before;
  case compare::Better::higher:
    return before - now;
  case compare::Better::nearZero:
    return std::abs(now) - std::abs(before);
  }
  return NAN;
}

// The conditions that differ, and where: the same difference is said once.
class OtherConditions {
public:
  void add(const std::vector<compare::ConditionDifference>& differences, const std::string& place) {
    for (const compare::ConditionDifference& difference : differences) {
      if (difference.actsOn != compare::ActsOn::figures && difference.actsOn != compare::ActsOn::wholes) continue;
      auto known = std::ranges::find(m_parts, difference.sentence, &Part::sentence);
      if (known == m_parts.end()) known = m_parts.insert(known, {difference.sentence, {}});
      if (!place.empty()) known->places.push_back(place);
    }
  }
  // One line, empty where nothing differs.
  std::string describe(std::size_t rows) const {
    if (m_parts.empty()) return {};
    std::vector<std::string> parts;
    for (const auto& [sentence, places] : m_parts)
      parts.push_back(places.empty() ? sentence : fmt::format("{} ({})", sentence, fmt::join(places, ", ")));
    const std::string effect = rows == 0   ? ""
                               : rows == 1 ? ", so one row is not comparable"
                                           : fmt::format(", so {} rows are not comparable", rows);
    return fmt::format("the baseline was made with other settings{}: {}", effect, fmt::join(parts, "; "));
  }

private:
  struct Part {
    std::string sentence;
    std::vector<std::string> places; // scenes and views; empty: the whole run
  };
  std::vector<Part> m_parts;
};

// Why the figures of a view, or of its whole image, are not of the same thing in both; empty where they are.
std::string describe(const std::vector<compare::ConditionDifference>& differences, bool ofWhole) {
  std::vector<std::string> sentences;
  for (const auto& [name, actsOn, sentence] : differences)
    if (actsOn == compare::ActsOn::figures || (ofWhole && actsOn == compare::ActsOn::wholes))
      sentences.push_back(sentence);
  return fmt::format("{}", fmt::join(sentences, "; "));
}

std::vector<compare::Condition> conditionsOfRun(const Report& report) {
  std::vector<compare::Condition> conditions = {{"device", report.device}};
  conditions.insert(conditions.end(), report.conditions.begin(), report.conditions.end());
  return conditions;
}

// before: null where the baseline does not have it. A check that is judged already could not be (not measured now).
// notComparable: as in BaselineChange.
void judgeRegression(compare::CheckResult& check, const compare::Figures* before, const compare::Figures& now,
                     const std::string& notComparable) {
  if (!check.regress || check.judged() || now.nonFinite > 0) return;
  if (before && !notComparable.empty()) {
    check.verdict = compare::Verdict::warn;
    check.unjudged = "not comparable: " + notComparable;
    return;
  }
  if (!before || before->pixels == 0) {
    check.verdict = compare::Verdict::warn;
    check.unjudged = !before ? "new: the baseline does not have it" : "the baseline does not show it";
    return;
  }
  check.unjudged = compare::describeTooDark(check.metric, now);
  if (!check.unjudged.empty()) {
    check.verdict = compare::Verdict::warn; // where nothing else judges
    return;
  }
  // Its figures hold the worst value there: against them a regression would look like an improvement.
  if (before->nonFinite > 0) {
    check.verdict = compare::Verdict::error;
    check.note = "non-finite pixels in the baseline";
    return;
  }
  const std::optional<double> old = before->find(check.metric);
  const std::shared_ptr<const compare::Statistic> statistic = compare::statisticByName(check.metric);
  if (!old || std::isnan(*old) || !statistic) {
    check.verdict = compare::Verdict::error;
    check.note = old ? "not a number in the baseline" : "not measured in the baseline";
    return;
  }
  check.value = worseBy(statistic->better, *old, now.find(check.metric).value_or(NAN));
  check.verdict = compare::judgeLevel(compare::Better::lower, check.value, check.warnAbove, check.failAbove);
}

BaselineChange hold(const compare::Figures& now, std::vector<compare::CheckResult>& checks,
                    const compare::Figures* before, compare::Verdict verdict, const std::string& notComparable,
                    BaselineSummary& summary) {
  for (compare::CheckResult& check : checks) judgeRegression(check, before, now, notComparable);
  BaselineChange change;
  change.isNew = before == nullptr;
  if (!before) return change;
  change.before = verdict;
  change.notComparable = notComparable;
  if (!notComparable.empty()) {
    if (before->pixels > 0 && now.pixels > 0) ++summary.notComparable;
    return change;
  }
  change.changes = changesOf(*before, now);
  return change;
}

bool isAskedFor(const BaselineOptions& options, const std::string& material) {
  return options.materials.empty() || std::ranges::any_of(options.materials, [&](const std::string& glob) {
           return base::matchesGlob(glob, material);
         });
}

// differences: of the run's conditions, the scene's and the view's.
void holdView(ViewResult& view, const ViewResult* before, const std::vector<compare::ConditionDifference>& differences,
              BaselineSummary& summary) {
  view.baseline = hold(view.whole, view.checks, before ? &before->whole : nullptr,
                       before ? before->wholeVerdict : compare::Verdict::pass, describe(differences, true), summary);
  const std::string notComparable = describe(differences, false);
  for (std::size_t i = 0; i < view.materials.size(); ++i) {
    MaterialResult& material = view.materials[i];
    const MaterialResult* then = before ? findNamesake(before->materials, view.materials, i) : nullptr;
    material.baseline = hold(material.figures, material.checks, then ? &then->figures : nullptr,
                             then ? then->verdict : compare::Verdict::pass, notComparable, summary);
    for (WhatIf& each : material.whatIf)
      for (compare::CheckResult& check : each.checks)
        judgeRegression(check, then ? &then->figures : nullptr, each.figures, notComparable);
    if (then && then->figures.pixels > 0 && material.figures.pixels > 0) ++summary.common;
  }
}

bool says(const SceneResult& scene, const std::string& condition) {
  return std::ranges::count(scene.conditions, condition, &compare::Condition::name) > 0;
}

// The views of a scene against the baseline's, each under the conditions of its run and its own.
void holdScene(SceneResult& scene, const Report& report, const SceneResult* before, const Report& baseline,
               OtherConditions& others, BaselineSummary& summary) {
  std::vector<compare::ConditionDifference> differences;
  if (before && !before->views.empty() && !scene.views.empty()) {
    differences = compare::differencesOf(compare::overlaid(conditionsOfRun(baseline), before->conditions),
                                         compare::overlaid(conditionsOfRun(report), scene.conditions));
    for (const compare::ConditionDifference& difference : differences)
      others.add({difference},
                 says(scene, difference.name) || says(*before, difference.name) ? "scene " + scene.name : "");
  }
  for (ViewResult& view : scene.views) {
    const ViewResult* then = before ? findByName(before->views, view.name) : nullptr;
    std::vector<compare::ConditionDifference> all = differences;
    if (then) {
      const std::vector<compare::ConditionDifference> ofView =
          compare::differencesOf(then->conditions, view.conditions);
      others.add(ofView, fmt::format("view {} of scene {}", view.name, scene.name));
      all.insert(all.end(), ofView.begin(), ofView.end());
    }
    holdView(view, then, all, summary);
  }
}

bool isAskedFor(const BaselineOptions& options, const std::string& scene, const ViewResult& view) {
  return isChosen(options.only, scene, view.name) &&
         (view.materials.empty() ||
          std::ranges::any_of(view.materials, [&](const auto& m) { return isAskedFor(options, m.name); }));
}

void collectGone(const ViewResult& before, const SceneResult& scene, const BaselineOptions& options,
                 std::vector<GoneRow>& gone) {
  if (!isAskedFor(options, scene.name, before)) return;
  const ViewResult* now = findByName(scene.views, before.name);
  if (!now) return gone.push_back({scene.name, before.name, ""});
  for (std::size_t i = 0; i < before.materials.size(); ++i)
    if (isAskedFor(options, before.materials[i].name) && !findNamesake(now->materials, before.materials, i))
      gone.push_back({scene.name, before.name, before.materials[i].name});
}

} // namespace

void compareWithBaseline(Report& report, const Report& baseline, const BaselineOptions& options) {
  BaselineSummary summary;
  const std::filesystem::path source(options.source);
  summary.source = (source.is_absolute() ? source.filename() : source).generic_string();
  summary.version = baseline.version;
  summary.device = baseline.device;
  summary.notWhole = whyNotWhole(baseline);
  OtherConditions others;
  const ScenesByName own(report.scenes), then(baseline.scenes);
  for (SceneResult& scene : report.scenes) holdScene(scene, report, then.find(scene.name), baseline, others, summary);
  for (const SceneResult& before : baseline.scenes) {
    const SceneResult* now = own.find(before.name);
    const auto isAsked = [&](const ViewResult& view) { return isAskedFor(options, before.name, view); };
    if (!now && !options.sameScenesOnly && before.error.empty() && std::ranges::any_of(before.views, isAsked))
      summary.gone.push_back({before.name, "", ""});
    if (!now || !now->error.empty()) continue; // what a scene that failed shows is not known
    for (const ViewResult& view : before.views) collectGone(view, *now, options, summary.gone);
  }
  // What an interrupted run did not get to may well be there.
  if (summary.common == 0 && countNotRun(report) == 0)
    summary.error = "no material of this run is visible in the baseline";
  if (std::string other = others.describe(summary.notComparable); !other.empty())
    report.warnings.push_back(std::move(other));
  report.baseline = std::move(summary);
  settleVerdicts(report);
}

} // namespace parity::report
