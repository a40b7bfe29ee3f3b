#include "history/run_adding.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/verdict/check.h"

namespace parity::history {

namespace {

constexpr const char* kMainFigure = "flip.mean";

bool isSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Of the events, the one that says most about a row.
std::string kindOf(bool hasChanged, const std::string& cause, const std::string& before, const std::string& now) {
  if (hasChanged && cause.empty()) return "nondeterministic";
  if (isFailing(now) && !isFailing(before)) return "regressed";
  if (isFailing(before) && !isFailing(now)) return "fixed";
  return "changed";
}

} // namespace

const Index::Subject& Index::Adding::subject(std::int64_t id) const { return index.m_subjects.at(id); }

void Index::Adding::event(std::int64_t about, const std::string& kind, const std::string& cause,
                          const std::optional<std::int64_t>& metric, double then, double here, std::size_t changed) {
  index.m_insertEvent.run(run, about, kind, cause, metric, then, here, changed);
}

void Index::Adding::insertState(std::int64_t id, Row& row, const std::string& verdict, const std::string& reason,
                                const std::string& rule, const PictureHashes& pictures) {
  row.firstRun = run, row.verdict = verdict, row.rule = rule;
  index.m_insertState.run(now->id, id, run, verdict, reason, rule, pictures.reference, pictures.test, pictures.flip);
}

void Index::Adding::close(std::int64_t id, const Row& row, std::int64_t lastSeen) {
  index.m_closeState.run(lastSeen, now->id, id, row.firstRun);
  for (const OpenValue& value : row.values) index.m_closeValue.run(lastSeen, now->id, id, value.metric, value.firstRun);
}

void Index::Adding::addSceneState(std::int64_t id, const SceneRecord& scene, const std::string& cause) {
  const std::string verdict = nameOf(scene.error.empty() ? compare::Verdict::pass : compare::Verdict::error);
  const Row* old = findOld(before, id);
  const char* worse = scene.error.starts_with("its worker failed") ? "crashed"
                      : scene.error.starts_with("sentinel:")       ? "nondeterministic"
                                                                   : "regressed";
  if (old && old->verdict != verdict)
    event(id, scene.error.empty() ? "fixed" : worse, cause);
  else if (!old && before && !scene.error.empty())
    event(id, worse, cause);
  if (!old) added.push_back(id);
  if (old && before == now && old->verdict == verdict && old->rule == scene.error) return;
  if (old && before == now)
    index.m_closeState.run(old->verdict == nameOf(compare::Verdict::error) ? previous : lastSeenOf(id), now->id, id,
                           old->firstRun);
  Row& row = now->rows[id];
  row.seenBy = run;
  insertState(id, row, verdict, scene.error, scene.error, {}); // another error begins another state
}

Index::Lane* Index::Adding::laneOf(std::int64_t sceneId) const {
  const bool isOlder = older && !before->scenes.contains(sceneId) && older->scenes.contains(sceneId);
  return isOlder ? older : before;
}

std::int64_t Index::Adding::lastSeenOf(std::int64_t sceneId) const {
  const Lane& lane = *laneOf(sceneId);
  const auto found = lane.scenes.find(sceneId);
  return found == lane.scenes.end() ? previous : found->second.lastRun;
}

const Index::Row* Index::Adding::findOld(Lane* lane, std::int64_t id) const {
  if (!lane) return nullptr;
  const auto found = lane->rows.find(id);
  if (found == lane->rows.end()) return nullptr;
  found->second.seenBy = run;
  return &found->second;
}

void Index::Adding::addRow(std::int64_t id, std::int64_t sceneId, const RowRecord& record_, const std::string& cause,
                           std::int64_t lastSeen) {
  const std::string verdict = nameOf(record_.verdict);
  std::vector<OpenValue> values;
  values.reserve(record_.figures.size());
  for (const compare::Figure& figure : record_.figures)
    values.push_back({index.metricOf(figure.name), run, figure.value});
  std::ranges::sort(values, {}, &OpenValue::metric);
  Lane* const from = laneOf(sceneId);
  const Row* old = findOld(from, id);
  if (!old) {
    added.push_back(id);
    Row& row = now->rows[id];
    row.seenBy = run;
    insertState(id, row, verdict, record_.reason, record_.rule, record_.pictures);
    for (const OpenValue& value : values) index.m_insertValue.run(now->id, id, value.metric, run, value.value);
    row.values = std::move(values);
    return;
  }
  // What both have, and what one alone has: --metrics may be another list.
  std::optional<std::size_t> told;
  std::size_t changed = 0;
  double then = NAN;
  std::vector<bool> isKept(values.size());
  auto at = old->values.begin();
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (at != old->values.end() && at->metric < values[i].metric) ++at;
    if (at == old->values.end() || at->metric != values[i].metric) continue;
    if (isSame(at->value, values[i].value)) {
      isKept[i] = from == now;
      if (isKept[i]) values[i].firstRun = at->firstRun;
      continue;
    }
    ++changed;
    if (!told || values[i].metric == index.metricOf(kMainFigure)) told = i, then = at->value;
  }
  // A row that is seen now and was not, or the other way about, has no common figure.
  const bool hasChanged = changed > 0 || old->values.empty() != values.empty();
  if (hasChanged || old->verdict != verdict) {
    const std::string why = hasChanged ? cause : judgingCause(makers(sceneId), index.makersOf(run));
    const std::string kind = kindOf(hasChanged, why, old->verdict, verdict);
    if (told)
      event(id, kind, why, values[*told].metric, then, values[*told].value, changed);
    else
      event(id, kind, why);
  }
  Row& row = now->rows[id]; // may be *old
  const bool hasSameState = from == now && old->verdict == verdict && old->rule == record_.rule;
  row.seenBy = run;
  if (from == now)
    for (const OpenValue& value : old->values) {
      const auto same = std::ranges::find(values, value.metric, &OpenValue::metric);
      if (same == values.end() || same->firstRun == run)
        index.m_closeValue.run(lastSeen, now->id, id, value.metric, value.firstRun);
    }
  if (!hasSameState) {
    if (from == now) index.m_closeState.run(lastSeen, now->id, id, old->firstRun);
    insertState(id, row, verdict, record_.reason, record_.rule, record_.pictures);
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!isKept[i]) index.m_insertValue.run(now->id, id, values[i].metric, run, values[i].value);
  row.values = std::move(values);
}

const Makers& Index::Adding::makers(std::int64_t sceneId) const { return index.makersOf(lastSeenOf(sceneId)); }

void Index::Adding::addScene(const SceneRecord& scene) {
  if (scene.verdict == compare::Verdict::notRun) return known.insert(sceneIdOf(scene)), void();
  const std::int64_t sceneId = sceneIdOf(scene);
  known.insert(sceneId);
  std::string cause;
  const Lane* const from = laneOf(sceneId);
  const bool wasSeen = from && from->scenes.contains(sceneId);
  if (wasSeen) cause = causesOf(makers(sceneId), from->scenes.at(sceneId).inputs, index.makersOf(run), scene.inputs);
  const std::int64_t lastSeen = wasSeen ? lastSeenOf(sceneId) : previous;
  addSceneState(sceneId, scene, cause);
  if (!scene.error.empty()) return; // what a scene that failed shows is not known
  compared.insert(sceneId);
  if (from && from == older) fromOlder.insert(sceneId);
  for (const ViewRecord& view : scene.views) {
    Subject whole{scene.name, view.name, "", kWhole, sceneId, 0};
    const std::int64_t wholeId = index.subjectOf(record.suite, whole);
    addRow(wholeId, sceneId, view.whole, cause, lastSeen);
    std::unordered_map<std::string, int> namesakes;
    for (const RowRecord& material : view.materials) {
      const Subject subject_{scene.name, view.name, material.name, namesakes[material.name]++, sceneId, wholeId};
      addRow(index.subjectOf(record.suite, subject_), sceneId, material, cause, lastSeen);
    }
  }
  addInputs(sceneId, scene.inputs);
}

std::int64_t Index::Adding::sceneIdOf(const SceneRecord& scene) const {
  return index.subjectOf(record.suite, {scene.name, "", "", kScene, 0, 0});
}

void Index::Adding::addInputs(std::int64_t sceneId, const report::SceneInputs& inputs) {
  SceneNow& scene = now->scenes[sceneId];
  const report::SceneInputs& old = scene.inputs;
  const bool isSameAsBefore = scene.firstRun != 0 && old.asset == inputs.asset &&
                              old.environment == inputs.environment && old.request == inputs.request &&
                              old.bake == inputs.bake && old.pictures == inputs.pictures;
  scene.previousRun = std::exchange(scene.lastRun, run);
  if (isSameAsBefore) return index.m_extendInput.run(run, now->id, sceneId, scene.firstRun);
  scene.inputs = inputs, scene.firstRun = run;
  index.m_insertInput.run(now->id, sceneId, run, run, inputs.asset, inputs.environment, inputs.request, inputs.bake,
                          inputs.pictures);
}

void Index::Adding::addNewAndGone() {
  if (!before) return;
  const auto tell = [&](const std::vector<std::int64_t>& ids, const std::string& kind) {
    const std::unordered_set<std::int64_t> all(ids.begin(), ids.end());
    for (const std::int64_t id : ids) {
      const Subject& each = subject(id);
      if (all.contains(each.sceneId) || (each.ordinal != kWhole && all.contains(each.wholeId))) continue;
      event(id, kind, "");
    }
  };
  tell(added, "new");
  std::vector<std::int64_t> gone;
  for (const auto& [id, row] : before->rows) {
    if (row.seenBy == run) continue;
    const Subject& each = subject(id);
    const std::int64_t sceneId = each.ordinal == kScene ? id : each.sceneId;
    if (compared.contains(sceneId) || (!known.contains(sceneId) && record.isComplete)) gone.push_back(id);
  }
  if (older)
    for (const auto& [id, row] : older->rows)
      if (row.seenBy != run && fromOlder.contains(subject(id).sceneId)) gone.push_back(id);
  std::ranges::sort(gone);
  tell(gone, "gone");
  if (before != now) return;
  for (const std::int64_t id : gone) {
    const Subject& each = subject(id);
    const auto row = now->rows.find(id);
    if (row == now->rows.end()) continue; // of the older lane
    const bool wasError = each.ordinal == kScene && row->second.verdict == nameOf(compare::Verdict::error);
    close(id, row->second, wasError ? previous : goneAfter(each.ordinal == kScene ? id : each.sceneId));
    now->rows.erase(row);
  }
}

// A scene that was compared by this run has it as its last one already.
std::int64_t Index::Adding::goneAfter(std::int64_t sceneId) const {
  const std::int64_t last = lastSeenOf(sceneId);
  return last == run ? before->scenes.at(sceneId).previousRun : last;
}

void Index::Adding::addCrashes() {
  for (const std::string& incident : record.incidents)
    for (const SceneRecord& scene : record.scenes)
      if (incident.starts_with(scene.name + ": flaky crash")) {
        event(sceneIdOf(scene), "crashed", "flaky");
        break;
      }
}

} // namespace parity::history
