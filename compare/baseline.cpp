// Counterparts by name, the changes between them, and what has none.
#include "compare/baseline.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/glob.h"
#include "compare/budget.h"
#include "compare/statistic.h"

namespace parity::compare {
namespace {

template <typename Named> const Named* findByName(const std::vector<Named>& list, const std::string& name) {
  const auto found = std::ranges::find(list, name, &Named::name);
  return found == list.end() ? nullptr : &*found;
}

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

std::vector<FigureChange> changesOf(const Figures& before, const Figures& now) {
  std::vector<FigureChange> changes;
  if (before.pixels == 0 || now.pixels == 0 || before.nonFinite > 0) return changes;
  for (const Figure& figure : now.values)
    if (const std::optional<double> then = before.find(figure.name))
      changes.push_back({figure.name, *then, figure.value});
  return changes;
}

double worseBy(Better better, double before, double now) {
  if (before == now) return 0; // also of infinities
  switch (better) {
  case Better::lower:
    return now - before;
  case Better::higher:
    return before - now;
  case Better::nearZero:
    return std::abs(now) - std::abs(before);
  }
  return NAN;
}

// The conditions that differ, and where: the same difference is said once.
class OtherConditions {
public:
  void add(const std::vector<ConditionDifference>& differences, const std::string& place) {
    for (const ConditionDifference& difference : differences) {
      if (difference.actsOn != ActsOn::figures && difference.actsOn != ActsOn::wholes) continue;
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
    return fmt::format("the baseline was made otherwise{}: {}", effect, fmt::join(parts, "; "));
  }

private:
  struct Part {
    std::string sentence;
    std::vector<std::string> places; // scenes and views; empty: the whole run
  };
  std::vector<Part> m_parts;
};

// Why the figures of a view, or of its whole image, are not of the same thing in both; empty where they are.
std::string describe(const std::vector<ConditionDifference>& differences, bool ofWhole) {
  std::vector<std::string> sentences;
  for (const auto& [actsOn, sentence] : differences)
    if (actsOn == ActsOn::figures || (ofWhole && actsOn == ActsOn::wholes)) sentences.push_back(sentence);
  return fmt::format("{}", fmt::join(sentences, "; "));
}

std::vector<Condition> conditionsOfRun(const Report& report) {
  std::vector<Condition> conditions = {{"device", report.device}};
  conditions.insert(conditions.end(), report.conditions.begin(), report.conditions.end());
  return conditions;
}

// before: null where the baseline does not have it. A check that is judged already could not be (not measured now).
// notComparable: as in BaselineChange.
void judgeRegression(CheckResult& check, const Figures* before, const Figures& now, const std::string& notComparable) {
  if (!check.regress || check.judged()) return;
  if (before && !notComparable.empty()) {
    check.verdict = Verdict::warn;
    check.unjudged = "not comparable: " + notComparable;
    return;
  }
  if (!before || before->pixels == 0) {
    check.verdict = Verdict::warn;
    check.unjudged = !before ? "new, the baseline does not have it" : "the baseline does not show it";
    return;
  }
  check.unjudged = describeTooDark(check.metric, now);
  if (!check.unjudged.empty()) {
    check.verdict = Verdict::warn; // where nothing else judges
    return;
  }
  // Its figures hold the worst value there: against them a regression would look like an improvement.
  if (before->nonFinite > 0) {
    check.verdict = Verdict::error;
    check.note = "non-finite pixels in the baseline";
    return;
  }
  const std::optional<double> old = before->find(check.metric);
  const std::optional<Statistic> statistic = statisticByName(check.metric);
  if (!old || std::isnan(*old) || !statistic) {
    check.verdict = Verdict::error;
    check.note = old ? "not a number in the baseline" : "not measured in the baseline";
    return;
  }
  check.value = worseBy(statistic->better, *old, now.find(check.metric).value_or(NAN));
  check.verdict = judgeLevel(Better::lower, check.value, check.warnAbove, check.failAbove);
}

BaselineChange hold(const Figures& now, std::vector<CheckResult>& checks, const Figures* before, Verdict verdict,
                    const std::string& notComparable, BaselineSummary& summary) {
  for (CheckResult& check : checks) judgeRegression(check, before, now, notComparable);
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
void holdView(ViewResult& view, const ViewResult* before, const std::vector<ConditionDifference>& differences,
              BaselineSummary& summary) {
  view.baseline = hold(view.whole, view.checks, before ? &before->whole : nullptr,
                       before ? before->wholeVerdict : Verdict::pass, describe(differences, true), summary);
  const std::string notComparable = describe(differences, false);
  for (std::size_t i = 0; i < view.materials.size(); ++i) {
    MaterialResult& material = view.materials[i];
    const MaterialResult* then = before ? findNamesake(before->materials, view.materials, i) : nullptr;
    material.baseline = hold(material.figures, material.checks, then ? &then->figures : nullptr,
                             then ? then->verdict : Verdict::pass, notComparable, summary);
    if (then && then->figures.pixels > 0 && material.figures.pixels > 0) ++summary.common;
  }
}

// The views of a scene against the baseline's; `differences` are of the run's conditions.
void holdScene(SceneResult& scene, const SceneResult* before, std::vector<ConditionDifference> differences,
               OtherConditions& others, BaselineSummary& summary) {
  const auto add = [](std::vector<ConditionDifference>& to, const std::vector<ConditionDifference>& more) {
    to.insert(to.end(), more.begin(), more.end());
  };
  if (before && !before->views.empty() && !scene.views.empty()) {
    const std::vector<ConditionDifference> ofScene = differencesOf(before->conditions, scene.conditions);
    others.add(ofScene, "scene " + scene.name);
    add(differences, ofScene);
  }
  for (ViewResult& view : scene.views) {
    const ViewResult* then = before ? findByName(before->views, view.name) : nullptr;
    std::vector<ConditionDifference> all = differences;
    if (then) {
      const std::vector<ConditionDifference> ofView = differencesOf(then->conditions, view.conditions);
      others.add(ofView, fmt::format("view {} of scene {}", view.name, scene.name));
      add(all, ofView);
    }
    holdView(view, then, all, summary);
  }
}

void collectGone(const ViewResult& before, const SceneResult& scene, const BaselineOptions& options,
                 std::vector<GoneRow>& gone) {
  const ViewResult* now = findByName(scene.views, before.name);
  if (!now) {
    if (before.materials.empty() ||
        std::ranges::any_of(before.materials, [&](const auto& m) { return isAskedFor(options, m.name); }))
      gone.push_back({scene.name, before.name, ""});
    return;
  }
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
  const std::vector<ConditionDifference> ofRun = differencesOf(conditionsOfRun(baseline), conditionsOfRun(report));
  OtherConditions others;
  others.add(ofRun, "");
  for (SceneResult& scene : report.scenes)
    holdScene(scene, findByName(baseline.scenes, scene.name), ofRun, others, summary);
  for (const SceneResult& before : baseline.scenes) {
    const SceneResult* now = findByName(report.scenes, before.name);
    if (!now && !options.sameScenesOnly && before.error.empty()) summary.gone.push_back({before.name, "", ""});
    if (!now || !now->error.empty()) continue; // what a scene that failed shows is not known
    for (const ViewResult& view : before.views) collectGone(view, *now, options, summary.gone);
  }
  if (summary.common == 0) summary.error = "nothing in common: no material that this run shows is shown in it";
  if (std::string other = others.describe(summary.notComparable); !other.empty())
    report.warnings.push_back(std::move(other));
  report.baseline = std::move(summary);
  settleVerdicts(report);
}

} // namespace parity::compare
