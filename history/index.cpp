#include "history/index.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "compare/pooling/statistic.h"

namespace parity::history {

namespace {

constexpr const char *kMainFigure = "flip.mean", *kSceneStage = "scene";

bool isFailing(const std::string& verdict) {
  return verdict == nameOf(compare::Verdict::fail) || verdict == nameOf(compare::Verdict::error);
}

bool isSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

std::string keyOf(const std::string& scene, const std::string& view, const std::string& material, int ordinal) {
  return scene + '\0' + view + '\0' + material + '\0' + std::to_string(ordinal);
}

std::string nameOfBetter(compare::Better better) {
  return better == compare::Better::lower ? "lower" : better == compare::Better::higher ? "higher" : "near zero";
}

// Of the events, the one that says most about a row.
std::string kindOf(bool hasChanged, const std::string& cause, const std::string& before, const std::string& now) {
  if (hasChanged && cause.empty()) return "nondeterministic";
  if (isFailing(now) && !isFailing(before)) return "regressed";
  if (isFailing(before) && !isFailing(now)) return "fixed";
  return "changed";
}

} // namespace

Index::Index(const Database& database)
    : m_database(database), m_insertValue(database.prepare("INSERT INTO value VALUES(?,?,?,?,NULL,?)")),
      m_closeValue(database.prepare(
          "UPDATE value SET last_run=? WHERE lane=? AND subject=? AND metric=? AND first_run=? AND last_run IS NULL")),
      m_insertState(database.prepare("INSERT INTO state VALUES(?,?,?,NULL,?,?,?,?,?,?)")),
      m_closeState(database.prepare("UPDATE state SET last_run=? WHERE lane=? AND subject=? AND first_run=?")),
      m_insertInput(database.prepare("INSERT INTO input VALUES(?,?,?,?,?,?,?,?)")),
      m_extendInput(database.prepare("UPDATE input SET last_run=? WHERE lane=? AND scene=? AND first_run=?")),
      m_insertEvent(database.prepare("INSERT INTO event VALUES(NULL,?,?,?,?,?,?,?,?)")),
      m_insertTiming(database.prepare("INSERT OR IGNORE INTO timing VALUES(?,?,?,?,?,?,?)")),
      m_insertSubject(database.prepare("INSERT INTO subject VALUES(NULL,?,?,?,?,?)")),
      m_insertMetric(database.prepare("INSERT INTO metric VALUES(NULL,?,?)")) {
  Statement metrics = database.prepare("SELECT name, id FROM metric");
  while (metrics.step()) m_metrics.emplace(metrics.text(0), metrics.integer(1));
}

std::int64_t Index::metricOf(const std::string& name) {
  if (const auto found = m_metrics.find(name); found != m_metrics.end()) return found->second;
  const std::optional<compare::Statistic> known = compare::statisticByName(name);
  m_insertMetric.run(name, nameOfBetter(known ? known->better : compare::Better::lower));
  return m_metrics.emplace(name, m_database.lastId()).first->second;
}

void Index::loadSubjects(const std::string& suite) {
  if (m_hasSuite && m_suite == suite) return;
  m_ids.clear(), m_subjects.clear();
  m_suite = suite, m_hasSuite = true;
  Statement all =
      m_database.prepare("SELECT id, scene, view, material, ordinal FROM subject WHERE suite=? ORDER BY id");
  all.bind(suite);
  while (all.step()) {
    Subject subject{all.text(1), all.text(2), all.text(3), static_cast<int>(all.integer(4))};
    m_ids.emplace(keyOf(subject.scene, subject.view, subject.material, subject.ordinal), all.integer(0));
    m_subjects.emplace(all.integer(0), std::move(subject));
  }
  for (auto& [id, subject] : m_subjects) {
    if (subject.ordinal == kScene) continue;
    subject.sceneId = m_ids.at(keyOf(subject.scene, "", "", kScene));
    subject.wholeId = m_ids.at(keyOf(subject.scene, subject.view, "", kWhole));
  }
}

std::int64_t Index::subjectOf(const std::string& suite, const Subject& subject) {
  std::string key = keyOf(subject.scene, subject.view, subject.material, subject.ordinal);
  if (const auto found = m_ids.find(key); found != m_ids.end()) return found->second;
  m_insertSubject.run(suite, subject.scene, subject.view, subject.material, subject.ordinal);
  const std::int64_t id = m_database.lastId();
  m_ids.emplace(std::move(key), id);
  Subject& kept = m_subjects.emplace(id, subject).first->second;
  if (kept.ordinal == kWhole) kept.wholeId = id;
  return id;
}

std::int64_t Index::laneOf(const RunRecord& record) {
  Statement find = m_database.prepare("SELECT id FROM lane WHERE suite=? AND branch=? AND numerics=? AND settings=?");
  if (find.bind(record.suite, record.branch, record.numerics, record.settings).step()) return find.integer(0);
  m_database.prepare("INSERT INTO lane VALUES(NULL,?,?,?,?)")
      .run(record.suite, record.branch, record.numerics, record.settings);
  return m_database.lastId();
}

Index::Lane Index::read(std::int64_t id) const {
  Lane lane{id, {}, {}};
  Statement states =
      m_database.prepare("SELECT subject, first_run, verdict, rule FROM state WHERE lane=? AND last_run IS NULL");
  states.bind(id);
  while (states.step())
    lane.rows.emplace(states.integer(0), Row{states.integer(1), 0, states.text(2), states.text(3), {}});
  Statement values = m_database.prepare(
      "SELECT subject, metric, first_run, v FROM value INDEXED BY value_now WHERE lane=? AND last_run IS NULL");
  values.bind(id);
  std::int64_t subject = 0;
  for (Row* row = nullptr; values.step();) {
    if (!row || subject != values.integer(0)) row = &lane.rows[subject = values.integer(0)];
    row->values.push_back({values.integer(1), values.integer(2), values.real(3)});
  }
  Statement inputs =
      m_database.prepare("SELECT scene, first_run, last_run, asset, environment, request, bake FROM input "
                         "WHERE lane=? ORDER BY scene, first_run");
  inputs.bind(id);
  while (inputs.step())
    lane.scenes[inputs.integer(0)] = {
        {inputs.text(3), inputs.text(4), inputs.text(5), inputs.text(6)}, inputs.integer(1), inputs.integer(2)};
  return lane;
}

Index::Lane& Index::load(std::int64_t lane) {
  if (!m_lane || m_lane->id != lane) m_lane = read(lane);
  return *m_lane;
}

const Makers& Index::makersOf(std::int64_t run) {
  if (const auto found = m_makers.find(run); found != m_makers.end()) return found->second;
  Statement find =
      m_database.prepare("SELECT build, device, driver, numerics, settings, budgets, machine FROM run WHERE id=?");
  Makers makers;
  if (find.bind(run).step())
    makers = {find.text(0), find.text(1), find.text(2), find.text(3), find.text(4), find.text(5), find.text(6)};
  return m_makers.emplace(run, std::move(makers)).first->second;
}

// One run on its way into the index.
struct Index::Adding {
  Index& index;
  const RunRecord& record;
  std::int64_t run = 0, previous = 0;                         // previous: that it is compared with
  Lane* before = nullptr;                                     // null: the first of its suite and branch
  Lane* now = nullptr;                                        // may be the same
  std::unordered_set<std::int64_t> compared = {}, known = {}; // scenes: that were compared, that the run has
  std::vector<std::int64_t> added = {};                       // subjects that are new

  const Subject& subject(std::int64_t id) const { return index.m_subjects.at(id); }

  void event(std::int64_t about, const std::string& kind, const std::string& cause,
             const std::optional<std::int64_t>& metric = {}, double then = NAN, double here = NAN,
             std::size_t changed = 0) {
    index.m_insertEvent.run(run, about, kind, cause, metric, then, here, changed);
  }

  void insertState(std::int64_t id, Row& row, const std::string& verdict, const std::string& reason,
                   const std::string& rule, const PictureHashes& pictures) {
    row.firstRun = run, row.verdict = verdict, row.rule = rule;
    index.m_insertState.run(now->id, id, run, verdict, reason, rule, pictures.reference, pictures.test, pictures.flip);
  }

  // lastSeen: the run that showed the subject last.
  void close(std::int64_t id, const Row& row, std::int64_t lastSeen) {
    index.m_closeState.run(lastSeen, now->id, id, row.firstRun);
    for (const OpenValue& value : row.values)
      index.m_closeValue.run(lastSeen, now->id, id, value.metric, value.firstRun);
  }

  // Of a scene: that it could be compared, or why not.
  void addSceneState(std::int64_t id, const SceneRecord& scene, const std::string& cause) {
    const std::string verdict = nameOf(scene.error.empty() ? compare::Verdict::pass : compare::Verdict::error);
    const Row* old = findOld(id);
    const char* worse = scene.error.starts_with("its worker failed") ? "crashed"
                        : scene.error.starts_with("sentinel:")       ? "nondeterministic"
                                                                     : "regressed";
    if (old && old->verdict != verdict)
      event(id, scene.error.empty() ? "fixed" : worse, cause);
    else if (!old && before && !scene.error.empty())
      event(id, worse, cause);
    if (!old) added.push_back(id);
    if (old && before == now && old->verdict == verdict) return;
    if (old && before == now)
      index.m_closeState.run(old->verdict == nameOf(compare::Verdict::error) ? previous : lastSeenOf(id), now->id, id,
                             old->firstRun);
    Row& row = now->rows[id];
    row.seenBy = run;
    insertState(id, row, verdict, scene.error, "", {});
  }

  // Its own last run: while the scene has errors nothing of it is seen.
  std::int64_t lastSeenOf(std::int64_t sceneId) const {
    const auto found = before->scenes.find(sceneId);
    return found == before->scenes.end() ? previous : found->second.lastRun;
  }

  // What it was before; counted as seen.
  const Row* findOld(std::int64_t id) const {
    if (!before) return nullptr;
    const auto found = before->rows.find(id);
    if (found == before->rows.end()) return nullptr;
    found->second.seenBy = run;
    return &found->second;
  }

  void addRow(std::int64_t id, std::int64_t sceneId, const RowRecord& record_, const std::string& cause,
              std::int64_t lastSeen) {
    const std::string verdict = nameOf(record_.verdict);
    std::vector<OpenValue> values;
    values.reserve(record_.figures.size());
    for (const compare::Figure& figure : record_.figures)
      values.push_back({index.metricOf(figure.name), run, figure.value});
    std::ranges::sort(values, {}, &OpenValue::metric);
    const Row* old = findOld(id);
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
        isKept[i] = before == now;
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
    const bool hasSameState = before == now && old->verdict == verdict && old->rule == record_.rule;
    row.seenBy = run;
    if (before == now)
      for (const OpenValue& value : old->values) {
        const auto same = std::ranges::find(values, value.metric, &OpenValue::metric);
        if (same == values.end() || same->firstRun == run)
          index.m_closeValue.run(lastSeen, now->id, id, value.metric, value.firstRun);
      }
    if (!hasSameState) {
      if (before == now) index.m_closeState.run(lastSeen, now->id, id, old->firstRun);
      insertState(id, row, verdict, record_.reason, record_.rule, record_.pictures);
    }
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!isKept[i]) index.m_insertValue.run(now->id, id, values[i].metric, run, values[i].value);
    row.values = std::move(values);
  }

  const Makers& makers(std::int64_t sceneId) const { return index.makersOf(lastSeenOf(sceneId)); }

  void addScene(const SceneRecord& scene) {
    if (scene.verdict == compare::Verdict::notRun) return known.insert(sceneIdOf(scene)), void();
    const std::int64_t sceneId = sceneIdOf(scene);
    known.insert(sceneId);
    std::string cause;
    const bool wasSeen = before && before->scenes.contains(sceneId);
    if (wasSeen)
      cause = causesOf(makers(sceneId), before->scenes.at(sceneId).inputs, index.makersOf(run), scene.inputs);
    const std::int64_t lastSeen = wasSeen ? lastSeenOf(sceneId) : previous;
    addSceneState(sceneId, scene, cause);
    if (!scene.error.empty()) return; // what a scene that failed shows is not known
    compared.insert(sceneId);
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

  std::int64_t sceneIdOf(const SceneRecord& scene) const {
    return index.subjectOf(record.suite, {scene.name, "", "", kScene, 0, 0});
  }

  void addInputs(std::int64_t sceneId, const report::SceneInputs& inputs) {
    SceneNow& scene = now->scenes[sceneId];
    const report::SceneInputs& old = scene.inputs;
    const bool isSameAsBefore = scene.firstRun != 0 && old.asset == inputs.asset &&
                                old.environment == inputs.environment && old.request == inputs.request &&
                                old.bake == inputs.bake;
    scene.previousRun = std::exchange(scene.lastRun, run);
    if (isSameAsBefore) return index.m_extendInput.run(run, now->id, sceneId, scene.firstRun);
    scene.inputs = inputs, scene.firstRun = run;
    index.m_insertInput.run(now->id, sceneId, run, run, inputs.asset, inputs.environment, inputs.request, inputs.bake);
  }

  // One event for a whole scene or view.
  void addNewAndGone() {
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
    std::ranges::sort(gone);
    tell(gone, "gone");
    if (before != now) return;
    for (const std::int64_t id : gone) {
      const Subject& each = subject(id);
      const auto row = now->rows.find(id);
      const bool wasError = each.ordinal == kScene && row->second.verdict == nameOf(compare::Verdict::error);
      close(id, row->second, wasError ? previous : goneAfter(each.ordinal == kScene ? id : each.sceneId));
      now->rows.erase(row);
    }
  }
  // A scene that was compared by this run has it as its last one already.
  std::int64_t goneAfter(std::int64_t sceneId) const {
    const std::int64_t last = lastSeenOf(sceneId);
    return last == run ? before->scenes.at(sceneId).previousRun : last;
  }

  void addCrashes() {
    for (const std::string& incident : record.incidents)
      for (const SceneRecord& scene : record.scenes)
        if (incident.starts_with(scene.name + ": flaky crash")) {
          event(sceneIdOf(scene), "crashed", "flaky");
          break;
        }
  }
};

std::int64_t Index::insertRun(const RunRecord& record, const std::string& name, std::optional<std::int64_t> lane,
                              std::optional<std::int64_t> before) {
  std::int64_t rows = 0, failed = 0, warned = 0;
  for (const SceneRecord& scene : record.scenes)
    for (const ViewRecord& view : scene.views)
      for (const RowRecord& row : view.materials) {
        ++rows;
        failed += row.verdict == compare::Verdict::fail || row.verdict == compare::Verdict::error ? 1 : 0;
        warned += row.verdict == compare::Verdict::warn ? 1 : 0;
      }
  m_database.prepare("INSERT INTO run VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .run(name, record.started, record.suite, record.branch, record.commit, record.commitTime, record.version,
           record.build, record.device, record.driver, record.numerics, record.machine, record.settings, record.budgets,
           record.report, record.isComplete, record.isWhole, nameOf(record.verdict), rows, failed, warned, lane,
           before);
  return m_database.lastId();
}

void Index::insertTimings(Adding& adding) {
  constexpr double kMs = 1000;
  const auto known = [](double seconds) { return seconds > 0 ? seconds * kMs : NAN; };
  for (const SceneRecord& scene : adding.record.scenes)
    if (scene.wallS > 0)
      m_insertTiming.run(adding.run, adding.sceneIdOf(scene), kSceneStage, known(scene.cpuS), known(scene.wallS),
                         scene.isCached, scene.machine.empty() ? adding.record.machine : scene.machine);
  for (const auto& [stage, timeMs] : adding.record.stages)
    m_insertTiming.run(adding.run, 0, stage, NAN, timeMs, false, adding.record.machine);
}

void Index::add(const RunRecord& record, const std::string& name) {
  loadSubjects(record.suite);
  if (!record.isWhole) { // of what it left out nothing is known
    insertRun(record, name, {}, {});
    return;
  }
  const std::int64_t lane = laneOf(record);
  Statement newest = m_database.prepare("SELECT max(id) FROM run WHERE lane=?");
  std::optional<std::int64_t> before;
  if (newest.bind(lane).step() && !newest.isNull(0)) before = newest.integer(0);
  std::int64_t beforeLane = lane;
  if (!before) {
    Statement other = m_database.prepare(
        "SELECT id, lane FROM run WHERE suite=? AND branch=? AND lane IS NOT NULL ORDER BY id DESC LIMIT 1");
    if (other.bind(record.suite, record.branch).step()) before = other.integer(0), beforeLane = other.integer(1);
  }
  const std::int64_t run = insertRun(record, name, lane, before);
  Adding adding{*this, record, run, before.value_or(0)};
  std::optional<Lane> other, fresh;
  if (before && beforeLane == lane) {
    adding.before = adding.now = &load(lane);
  } else {
    if (before) adding.before = &other.emplace(read(beforeLane));
    adding.now = &fresh.emplace(Lane{lane, {}, {}});
  }
  for (const SceneRecord& scene : record.scenes) adding.addScene(scene);
  adding.addNewAndGone();
  adding.addCrashes();
  insertTimings(adding);
  if (fresh) m_lane = std::move(fresh);
}

} // namespace parity::history
