// Runs put into the index, one after the other: intervals, inputs, timings, and the events that a run brings.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "history/causes.h"
#include "history/database.h"
#include "history/run.h"

namespace parity::history {

inline constexpr int kWhole = -1, kScene = -2; // subject.ordinal of what is no material

class Index {
public:
  // The database must have its tables (history/schema.h), and outlive this.
  explicit Index(const Database& database);

  // The newest run; within a transaction of the caller. name: of its file. Throws Error.
  void add(const RunRecord& record, const std::string& name);

private:
  struct Subject {
    std::string scene, view, material;
    int ordinal = 0;
    std::int64_t sceneId = 0, wholeId = 0; // of its view's whole image; 0: it is a scene
  };
  struct OpenValue {
    std::int64_t metric = 0, firstRun = 0;
    double value = 0;
  };
  struct Row {                             // an open state, and its open values
    std::int64_t firstRun = 0, seenBy = 0; // run
    std::string verdict, rule;
    std::vector<OpenValue> values; // by metric
  };
  struct SceneNow {
    report::SceneInputs inputs;
    std::int64_t firstRun = 0, lastRun = 0; // of these inputs
    std::int64_t previousRun = 0;           // that compared the scene before the last one did
  };
  struct Lane {
    std::int64_t id = 0;
    std::unordered_map<std::int64_t, Row> rows;        // by subject
    std::unordered_map<std::int64_t, SceneNow> scenes; // by subject
  };
  struct Adding; // of one run (history/run_adding.h)

  std::int64_t laneOf(const RunRecord& record);
  std::int64_t metricOf(const std::string& name);
  std::int64_t subjectOf(const std::string& suite, const Subject& subject);
  Lane& load(std::int64_t lane); // what is open there; at hand if it was the last one
  Lane read(std::int64_t lane) const;
  const Makers& makersOf(std::int64_t run);
  void loadSubjects(const std::string& suite);
  bool lacksAny(const Lane& lane, const RunRecord& record) const;
  std::optional<std::int64_t> laneBefore(std::int64_t lane) const; // the one that it went on from
  std::int64_t insertRun(const RunRecord& record, const std::string& name, std::optional<std::int64_t> lane,
                         std::optional<std::int64_t> before);
  void insertTimings(Adding& adding);

  const Database& m_database;
  Statement m_insertValue, m_closeValue, m_insertState, m_closeState, m_insertInput, m_extendInput, m_insertEvent,
      m_insertTiming, m_insertSubject, m_insertMetric;
  std::unordered_map<std::string, std::int64_t> m_metrics;
  std::string m_suite; // whose subjects are at hand
  bool m_hasSuite = false;
  std::unordered_map<std::string, std::int64_t> m_ids; // by keyOf
  std::unordered_map<std::int64_t, Subject> m_subjects;
  std::unordered_map<std::int64_t, Makers> m_makers; // by run
  std::optional<Lane> m_lane;
};

} // namespace parity::history
