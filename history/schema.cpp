#include "history/schema.h"

#include <string>

namespace parity::history {

namespace {

// Figures are deterministic, so a value, a state and an input are kept as intervals of runs, and an unchanged night
// adds none of them. last_run is NULL as long as the interval lasts: then nothing is written for what did not change.
//
// A lane is what is comparable: within one there is no noise. `before` is the run that another run is compared with:
// the one before it in its lane, or, at the begin of a lane, the newest of the suite and branch; NULL: there was none.
// A run that is not whole (--only, --material) has no lane.
//
// A subject is a material of a view (ordinal: its number among namesakes), a whole image (kWhole) or a scene (kScene).
constexpr const char* kTables = R"(
CREATE TABLE lane(id INTEGER PRIMARY KEY, suite TEXT NOT NULL, branch TEXT NOT NULL, numerics TEXT NOT NULL,
  settings TEXT NOT NULL, UNIQUE(suite, branch, numerics, settings));
CREATE TABLE run(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, started TEXT NOT NULL, suite TEXT NOT NULL,
  branch TEXT NOT NULL, commit_id TEXT NOT NULL, commit_time TEXT NOT NULL, version TEXT NOT NULL, build TEXT NOT NULL,
  device TEXT NOT NULL, driver TEXT NOT NULL, numerics TEXT NOT NULL, machine TEXT NOT NULL, settings TEXT NOT NULL,
  budgets TEXT NOT NULL, report TEXT NOT NULL, complete INTEGER NOT NULL, whole INTEGER NOT NULL, verdict TEXT NOT NULL,
  row_count INTEGER NOT NULL, failed INTEGER NOT NULL, warned INTEGER NOT NULL, broken INTEGER NOT NULL,
  lane INTEGER, before INTEGER);
CREATE INDEX run_of_lane ON run(lane, id);
CREATE INDEX run_of_commit ON run(commit_id);
CREATE TABLE subject(id INTEGER PRIMARY KEY, suite TEXT NOT NULL, scene TEXT NOT NULL, view TEXT NOT NULL,
  material TEXT NOT NULL, ordinal INTEGER NOT NULL, UNIQUE(suite, scene, view, material, ordinal));
CREATE TABLE metric(id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE, better TEXT NOT NULL);
CREATE TABLE value(lane INTEGER, subject INTEGER, metric INTEGER, first_run INTEGER, last_run INTEGER, v REAL,
  PRIMARY KEY(lane, subject, metric, first_run)) WITHOUT ROWID;
CREATE INDEX value_now ON value(lane, subject, metric, first_run, v) WHERE last_run IS NULL;
CREATE TABLE state(lane INTEGER, subject INTEGER, first_run INTEGER, last_run INTEGER, verdict TEXT NOT NULL,
  reason TEXT NOT NULL, rule TEXT NOT NULL, reference TEXT NOT NULL, test TEXT NOT NULL, flip TEXT NOT NULL,
  PRIMARY KEY(lane, subject, first_run)) WITHOUT ROWID;
CREATE INDEX state_now ON state(lane, subject, first_run, verdict, rule) WHERE last_run IS NULL;
CREATE TABLE input(lane INTEGER, scene INTEGER, first_run INTEGER, last_run INTEGER, asset TEXT NOT NULL,
  environment TEXT NOT NULL, request TEXT NOT NULL, bake TEXT NOT NULL, pictures TEXT NOT NULL,
  PRIMARY KEY(lane, scene, first_run)) WITHOUT ROWID;
CREATE TABLE timing(run INTEGER, scene INTEGER, stage TEXT NOT NULL, cpu_ms REAL, wall_ms REAL, cached INTEGER NOT NULL,
  machine TEXT, PRIMARY KEY(run, scene, stage)) WITHOUT ROWID;
CREATE TABLE event(id INTEGER PRIMARY KEY, run INTEGER NOT NULL, subject INTEGER NOT NULL, kind TEXT NOT NULL,
  cause TEXT NOT NULL, metric INTEGER, before REAL, after REAL, changed INTEGER NOT NULL);
CREATE INDEX event_of_run ON event(run, kind);
CREATE INDEX event_of_subject ON event(subject, run);
)";

} // namespace

void createTables(const Database& database) {
  Transaction transaction(database);
  database.execute(kTables);
  database.execute("PRAGMA user_version=" + std::to_string(kIndexSchema));
  transaction.commit();
}

int schemaOf(const Database& database) { return static_cast<int>(database.number("PRAGMA user_version").value_or(0)); }

} // namespace parity::history
