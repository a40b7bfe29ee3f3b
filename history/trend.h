// A row over the runs, as the pages show it: the JSON of Trend in report/dashboard/src/data/history.ts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/text/json_writer.h"
#include "history/subject.h"

namespace parity::history {

inline constexpr int kPageFormat = 1; // of the blocks "history" and "nights" of pages

struct TrendChange { // an event of the row, or an alarm of its scene
  std::int64_t run = 0;
  std::string kind, cause, metric;
  double before = 0, now = 0;
  std::size_t changed = 0; // figures
};

struct Trend {
  std::vector<Course> figures;
  std::vector<Interval> states;
  std::vector<TrendChange> changes;
};

// Reads rows, one after the other. All must outlive it.
class TrendReader {
public:
  TrendReader(const Database& index, const std::vector<LaneSpan>& lanes);
  // scene: the subject of its scene.
  Trend read(std::int64_t subject, std::int64_t scene);

private:
  const Database& m_index;
  const std::vector<LaneSpan>& m_lanes;
  Statement m_changes;
};

// The members of the object, which the caller begins and ends. runs: of the page, by their ids, oldest first: what is
// not of these is left out.
void writeTrend(base::JsonWriter& json, const Trend& trend, const std::vector<std::int64_t>& runs);
// The members of a change but "run".
void writeChange(base::JsonWriter& json, const std::string& kind, const std::string& cause, const std::string& metric,
                 double before, double now, std::size_t changed);

} // namespace parity::history
