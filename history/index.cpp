#include "history/index.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/pooling/statistic.h"
#include "history/run_adding.h"

namespace parity::history {

namespace {

constexpr const char* kSceneStage = "scene";

std::string keyOf(const std::string& scene, const std::string& view, const std::string& material, int ordinal) {
  return scene + '\0' + view + '\0' + material + '\0' + std::to_string(ordinal);
}

std::string nameOfBetter(compare::Better better) {
  return better == compare::Better::lower ? "lower" : better == compare::Better::higher ? "higher" : "near zero";
}

} // namespace

Index::Index(const Database& database)
    : m_database(database), m_insertValue(database.prepare("INSERT INTO value VALUES(?,?,?,?,NULL,?)")),
      m_closeValue(database.prepare(
          "UPDATE value SET last_run=? WHERE lane=? AND subject=? AND metric=? AND first_run=? AND last_run IS NULL")),
      m_insertState(database.prepare("INSERT INTO state VALUES(?,?,?,NULL,?,?,?,?,?,?)")),
      m_closeState(database.prepare("UPDATE state SET last_run=? WHERE lane=? AND subject=? AND first_run=?")),
      m_insertInput(database.prepare("INSERT INTO input VALUES(?,?,?,?,?,?,?,?,?)")),
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
  const std::shared_ptr<const compare::Statistic> known = compare::statisticByName(name);
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
      m_database.prepare("SELECT scene, first_run, last_run, asset, environment, request, bake, pictures FROM input "
                         "WHERE lane=? ORDER BY scene, first_run");
  inputs.bind(id);
  while (inputs.step())
    lane.scenes[inputs.integer(0)] = {{inputs.text(3), inputs.text(4), inputs.text(5), inputs.text(6), inputs.text(7)},
                                      inputs.integer(1),
                                      inputs.integer(2)};
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

std::int64_t Index::insertRun(const RunRecord& record, const std::string& name, std::optional<std::int64_t> lane,
                              std::optional<std::int64_t> before) {
  std::int64_t rows = 0, failed = 0, warned = 0, broken = 0;
  for (const SceneRecord& scene : record.scenes) {
    broken += scene.error.empty() ? 0 : 1;
    for (const ViewRecord& view : scene.views)
      for (const RowRecord& row : view.materials) {
        ++rows;
        failed += row.verdict == compare::Verdict::fail || row.verdict == compare::Verdict::error ? 1 : 0;
        warned += row.verdict == compare::Verdict::warn ? 1 : 0;
      }
  }
  m_database.prepare("INSERT INTO run VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .run(name, record.started, record.suite, record.branch, record.commit, record.commitTime, record.version,
           record.build, record.device, record.driver, record.numerics, record.machine, record.settings, record.budgets,
           record.report, record.isComplete, record.isWhole, nameOf(record.verdict), rows, failed, warned, broken, lane,
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

// Whether the run has compared a scene that the index knows and this lane does not: it failed in the lane's first run.
bool Index::lacksAny(const Lane& lane, const RunRecord& record) const {
  return std::ranges::any_of(record.scenes, [&](const SceneRecord& scene) {
    const auto known = m_ids.find(keyOf(scene.name, "", "", kScene));
    return scene.error.empty() && known != m_ids.end() && !lane.scenes.contains(known->second);
  });
}

std::optional<std::int64_t> Index::laneBefore(std::int64_t lane) const {
  Statement first = m_database.prepare(
      "SELECT (SELECT lane FROM run AS b WHERE b.id=run.before) FROM run WHERE lane=? ORDER BY id LIMIT 1");
  if (!first.bind(lane).step() || first.isNull(0)) return std::nullopt;
  return first.integer(0);
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
  std::optional<Lane> other, fresh, older;
  if (before && beforeLane == lane) {
    adding.before = adding.now = &load(lane);
  } else {
    if (before) adding.before = &other.emplace(read(beforeLane));
    adding.now = &fresh.emplace(Lane{lane, {}, {}});
  }
  if (adding.before && lacksAny(*adding.before, record))
    if (const std::optional<std::int64_t> from = laneBefore(beforeLane)) adding.older = &older.emplace(read(*from));
  for (const SceneRecord& scene : record.scenes) adding.addScene(scene);
  adding.addNewAndGone();
  adding.addCrashes();
  insertTimings(adding);
  if (fresh) m_lane = std::move(fresh);
}

} // namespace parity::history
