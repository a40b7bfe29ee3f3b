#include "history/trend.h"

#include <algorithm>
#include <functional>

namespace parity::history {

namespace {

// [[first, last, value], ...]
void writeSpans(base::JsonWriter& json, const std::vector<Interval>& intervals, const std::vector<std::int64_t>& runs,
                const std::function<void(const Interval&)>& writeValue) {
  json.beginArray();
  for (const Interval& each : intervals) {
    const auto first = std::ranges::lower_bound(runs, each.firstRun),
               end = std::ranges::upper_bound(runs, each.lastRun);
    if (first >= end) continue;
    json.beginArray();
    json.integer(first - runs.begin());
    json.integer(end - runs.begin() - 1);
    writeValue(each);
    json.endArray();
  }
  json.endArray();
}

} // namespace

TrendReader::TrendReader(const Database& index, const std::vector<LaneSpan>& lanes)
    : m_index(index), m_lanes(lanes),
      m_changes(index.prepare(
          "SELECT run, kind, cause, metric.name, before, after, changed FROM event LEFT JOIN metric ON "
          "metric.id=event.metric WHERE subject=?1 OR (subject=?2 AND kind IN ('crashed','nondeterministic')) "
          "ORDER BY run, event.id")) {}

Trend TrendReader::read(std::int64_t subject, std::int64_t scene) {
  Trend trend{coursesOf(m_index, m_lanes, subject), statesOf(m_index, m_lanes, subject), {}};
  m_changes.bind(subject, scene);
  while (m_changes.step())
    trend.changes.push_back({m_changes.integer(0), m_changes.text(1), m_changes.text(2), m_changes.text(3),
                             m_changes.real(4), m_changes.real(5), static_cast<std::size_t>(m_changes.integer(6))});
  return trend;
}

void writeChange(base::JsonWriter& json, const std::string& kind, const std::string& cause, const std::string& metric,
                 double before, double now, std::size_t changed) {
  json.key("kind").text(kind);
  json.key("cause").text(cause);
  json.key("metric").text(metric);
  json.key("before").number(before);
  json.key("after").number(now);
  json.key("figures").integer(changed);
}

void writeTrend(base::JsonWriter& json, const Trend& trend, const std::vector<std::int64_t>& runs) {
  json.key("figures").beginObject();
  for (const Course& course : trend.figures)
    writeSpans(json.key(course.name), course.values, runs, [&](const Interval& each) { json.number(each.value); });
  json.endObject();
  writeSpans(json.key("verdicts"), trend.states, runs, [&](const Interval& each) { json.text(each.verdict); });
  json.key("changes").beginArray();
  for (const TrendChange& each : trend.changes) {
    const auto run = std::ranges::lower_bound(runs, each.run);
    if (run == runs.end() || *run != each.run) continue;
    json.beginObject();
    json.key("run").integer(run - runs.begin());
    writeChange(json, each.kind, each.cause, each.metric, each.before, each.now, each.changed);
    json.endObject();
  }
  json.endArray();
}

} // namespace parity::history
