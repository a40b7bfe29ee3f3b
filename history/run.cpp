#include "history/run.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace parity::history {

namespace {

std::vector<compare::Figure> figuresOf(const compare::Figures& figures) {
  std::vector<compare::Figure> rounded;
  if (figures.pixels == 0) return rounded;
  rounded.reserve(figures.values.size());
  for (const compare::Figure& each : figures.values) rounded.push_back({each.name, roundedFigure(each.value)});
  std::ranges::sort(rounded, {}, &compare::Figure::name); // as JSON gives them back
  return rounded;
}

ViewRecord viewOf(const report::ViewResult& view) {
  ViewRecord record{view.name, {"", view.wholeVerdict, view.reason, view.rule.origin, figuresOf(view.whole)}, {}};
  record.materials.reserve(view.materials.size());
  for (const report::MaterialResult& material : view.materials)
    record.materials.push_back(
        {material.name, material.verdict, material.reason, material.rule.origin, figuresOf(material.figures)});
  return record;
}

} // namespace

double roundedFigure(double value) {
  if (!std::isfinite(value) || value == 0) return value;
  constexpr int kDigits = 4;
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, kDigits - 1).ptr;
  double rounded = value;
  std::from_chars(text.data(), end, rounded);
  return rounded;
}

RunRecord makeRecord(const report::Report& report, const report::RunInfo& run, const CommitInfo& commit) {
  RunRecord record;
  record.started = run.startedAt;
  record.suite = report.suite;
  record.branch = commit.branch, record.commit = commit.commit, record.commitTime = commit.commitTime;
  record.version = report.version;
  record.device = report.device;
  const report::RunOrigin& origin = run.origin;
  record.build = origin.build, record.driver = origin.driver;
  record.numerics = origin.numerics, record.machine = origin.machine;
  record.settings = report.digests.settings, record.budgets = report.digests.budgets;
  record.verdict = report.verdict;
  record.isComplete = origin.isComplete, record.isWhole = origin.isWhole;
  record.incidents = run.incidents;
  record.stages = run.timings;
  std::unordered_map<std::string_view, const report::SceneTime*> times;
  for (const report::SceneTime& each : run.sceneTimes) times.emplace(each.scene, &each);
  const std::unordered_set<std::string_view> cached(run.cachedScenes.begin(), run.cachedScenes.end());
  for (const report::SceneResult& scene : report.scenes) {
    SceneRecord& kept = record.scenes.emplace_back();
    kept.name = scene.name, kept.inputs = scene.inputs.value_or(report::SceneInputs{});
    kept.verdict = scene.verdict, kept.error = scene.error;
    kept.isCached = cached.contains(scene.name);
    if (const auto time = times.find(scene.name); time != times.end()) {
      kept.wallS = roundedFigure(time->second->seconds), kept.cpuS = roundedFigure(time->second->cpuSeconds);
      kept.machine = time->second->machine;
    }
    for (const report::ViewResult& view : scene.views) kept.views.push_back(viewOf(view));
  }
  return record;
}

bool isFailing(const std::string& verdict) {
  return verdict == nameOf(compare::Verdict::fail) || verdict == nameOf(compare::Verdict::error);
}

} // namespace parity::history
