// Counterparts by name, the changes between them, and what has none.
#include "compare/baseline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

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

// The settings that say which surfaces are in a whole image, and how they are shaded on request.
constexpr std::array<std::string_view, 2> kSettingsOfWholes = {"materials", "fully rough"};

// The truth judges nothing, and none of the figures that are held against the baseline's depends on it.
constexpr std::string_view kSettingOfTruth = "truth";

std::string settingOf(const Report& report, std::string_view name) {
  const auto found = std::ranges::find(report.settings, name, [](const auto& setting) { return setting.first; });
  return found == report.settings.end() ? "not recorded" : found->second;
}

// Why the whole images are not the same thing in both, empty where they are.
std::string describeOtherWholes(const Report& report, const Report& baseline) {
  for (const std::string_view name : kSettingsOfWholes)
    if (const std::string then = settingOf(baseline, name), now = settingOf(report, name); then != now)
      return fmt::format("the whole image was of another choice ({} '{}', now '{}')", name, then, now);
  return {};
}

// before: null where the baseline does not have it. A check that is judged already could not be (not measured now).
// other: not empty where the two cannot be held against each other, says why.
void judgeRegression(CheckResult& check, const RegionFigures* before, const RegionFigures& now,
                     const std::string& other) {
  if (!check.regress || check.judged()) return;
  if (before && !other.empty()) {
    check.verdict = Verdict::warn;
    check.unjudged = other;
    return;
  }
  const bool interior = check.region == nameOf(Region::interior);
  const Figures* then = !before ? nullptr : interior ? &before->interior : &before->all;
  if (!then || then->pixels == 0) {
    check.verdict = Verdict::warn;
    check.unjudged = !before                   ? "new, the baseline does not have it"
                     : before->all.pixels == 0 ? "the baseline does not show it"
                                               : "the baseline has no interior pixels of it";
    return;
  }
  check.unjudged.clear();
  // Its figures hold the worst value there: against them a regression would look like an improvement.
  if (before->all.nonFinite > 0) {
    check.verdict = Verdict::error;
    check.note = "non-finite pixels in the baseline";
    return;
  }
  const std::optional<double> old = then->find(check.metric);
  const std::optional<Statistic> statistic = statisticByName(check.metric);
  if (!old || std::isnan(*old) || !statistic) {
    check.verdict = Verdict::error;
    check.note = old ? "not a number in the baseline" : "not measured in the baseline";
    return;
  }
  check.value = worseBy(statistic->better, *old, (interior ? now.interior : now.all).find(check.metric).value_or(NAN));
  check.verdict = judgeLevel(Better::lower, check.value, check.warnAbove, check.failAbove);
}

BaselineChange hold(const RegionFigures& now, std::vector<CheckResult>& checks, const RegionFigures* before,
                    Verdict verdict, const std::string& other = {}) {
  for (CheckResult& check : checks) judgeRegression(check, before, now, other);
  BaselineChange change;
  change.isNew = before == nullptr;
  if (!before) return change;
  change.before = verdict;
  if (!other.empty()) return change;
  change.interior = changesOf(before->interior, now.interior);
  change.all = changesOf(before->all, now.all);
  return change;
}

bool isAskedFor(const BaselineOptions& options, const std::string& material) {
  return options.materials.empty() || std::ranges::any_of(options.materials, [&](const std::string& glob) {
           return base::matchesGlob(glob, material);
         });
}

void holdView(ViewResult& view, const ViewResult* before, const std::string& otherWholes, BaselineSummary& summary) {
  view.baseline = hold(view.whole, view.checks, before ? &before->whole : nullptr,
                       before ? before->wholeVerdict : Verdict::pass, otherWholes);
  for (std::size_t i = 0; i < view.materials.size(); ++i) {
    MaterialResult& material = view.materials[i];
    const MaterialResult* then = before ? findNamesake(before->materials, view.materials, i) : nullptr;
    material.baseline =
        hold(material.figures, material.checks, then ? &then->figures : nullptr, then ? then->verdict : Verdict::pass);
    if (then && then->figures.all.pixels > 0 && material.figures.all.pixels > 0) ++summary.common;
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

// What differs though it is not shading; one line, empty where nothing does.
std::string describeOtherConditions(const Report& report, const Report& baseline) {
  std::vector<std::string> parts;
  const auto compare = [&](const std::string& what, const std::string& then, const std::string& now) {
    if (then != now) parts.push_back(fmt::format("{} was '{}', is '{}'", what, then, now));
  };
  for (const auto& [name, value] : report.settings)
    if (std::ranges::find(kSettingsOfWholes, name) != kSettingsOfWholes.end())
      compare(name, settingOf(baseline, name), value);
    else if (name.starts_with("highend ") || name == "specular anti-aliasing" || name == "sun extraction")
      compare(name, settingOf(baseline, name), value); // also where an older version had none
    else if (name != kSettingOfTruth)
      for (const auto& [oldName, oldValue] : baseline.settings)
        if (name == oldName) compare(name, oldValue, value);
  compare("device", baseline.device, report.device);
  for (const SceneResult& scene : report.scenes)
    if (const SceneResult* before = findByName(baseline.scenes, scene.name);
        before && before->error.empty() && scene.error.empty()) {
      compare("environment of scene " + scene.name, before->environment, scene.environment);
      compare("sun of scene " + scene.name, before->sun, scene.sun);
      compare("light of scene " + scene.name, before->light, scene.light);
    }
  if (parts.empty()) return {};
  return fmt::format("the baseline was made otherwise, so changes are not of shading alone: {}",
                     fmt::join(parts, "; "));
}

} // namespace

void compareWithBaseline(Report& report, const Report& baseline, const BaselineOptions& options) {
  BaselineSummary summary;
  const std::filesystem::path source(options.source);
  summary.source = (source.is_absolute() ? source.filename() : source).generic_string();
  summary.version = baseline.version;
  summary.device = baseline.device;
  const std::string otherWholes = describeOtherWholes(report, baseline);
  for (SceneResult& scene : report.scenes) {
    const SceneResult* before = findByName(baseline.scenes, scene.name);
    for (ViewResult& view : scene.views)
      holdView(view, before ? findByName(before->views, view.name) : nullptr, otherWholes, summary);
  }
  for (const SceneResult& before : baseline.scenes) {
    const SceneResult* now = findByName(report.scenes, before.name);
    if (!now && !options.sameScenesOnly && before.error.empty()) summary.gone.push_back({before.name, "", ""});
    if (!now || !now->error.empty()) continue; // what a scene that failed shows is not known
    for (const ViewResult& view : before.views) collectGone(view, *now, options, summary.gone);
  }
  if (summary.common == 0) summary.error = "nothing in common: no material that this run shows is shown in it";
  if (std::string other = describeOtherConditions(report, baseline); !other.empty())
    report.warnings.push_back(std::move(other));
  report.baseline = std::move(summary);
  settleVerdicts(report);
}

} // namespace parity::compare
