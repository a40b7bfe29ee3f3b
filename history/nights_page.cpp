#include "history/nights_page.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text/json_writer.h"
#include "base/version.h"
#include "history/nights.h"
#include "history/timing_steps.h"
#include "history/trend.h"
#include "history/worst_rows.h"
#include "report/dashboard_files.h"
#include "report/data_page.h"

namespace parity::history {

namespace {

constexpr std::size_t kMostChanges = 200, kMostRows = 2000;

std::size_t gravityOf(const std::string& kind) {
  return static_cast<std::size_t>(std::ranges::find(kEventKinds, kind) - std::begin(kEventKinds));
}

void writeChanges(base::JsonWriter& json, std::vector<Event> events) {
  std::ranges::stable_sort(events, {}, [](const Event& event) { return gravityOf(event.kind); });
  json.beginArray();
  for (std::size_t i = 0; i < std::min(events.size(), kMostChanges); ++i) {
    const Event& event = events[i];
    json.beginObject();
    json.key("row").text(event.subject);
    writeChange(json, event.kind, event.cause, event.metric, event.before, event.now, event.changed);
    json.endObject();
  }
  json.endArray();
}

void writeNight(base::JsonWriter& json, const Database& index, const Night& night, const WorstRow* worst) {
  json.beginObject();
  json.key("name").text(night.run.name);
  json.key("started").text(night.run.started);
  json.key("commit").text(night.run.commit);
  json.key("verdict").text(night.run.verdict);
  json.key("rows").integer(night.rows);
  json.key("failed").integer(night.failed);
  json.key("warned").integer(night.warned);
  json.key("isComplete").boolean(night.isComplete);
  json.key("isWhole").boolean(night.isWhole);
  json.key("isFirst").boolean(night.isFirst);
  json.key("version").text(night.version);
  json.key("build").text(night.build);
  json.key("device").text(night.device);
  json.key("machine").text(night.machine);
  json.key("cpuS").number(night.cpuS);
  json.key("wallS").number(night.wallS);
  json.key("scenes").integer(night.scenes);
  json.key("cachedScenes").integer(night.cachedScenes);
  json.key("worst");
  if (worst && !worst->row.empty()) {
    json.beginObject();
    json.key("row").text(worst->row);
    json.key("flip").number(worst->value);
    json.endObject();
  } else {
    json.null();
  }
  json.key("meanFlip").number(worst ? worst->mean : NAN);
  json.key("events").beginObject();
  for (const auto& [kind, count] : night.events) json.key(kind).integer(count);
  json.endObject();
  writeChanges(json.key("changes"), night.isFirst ? std::vector<Event>() : eventsOf(index, night.run.id));
  json.endObject();
}

// Rows that an event of these runs was about, those that changed last at first; scenes and what came or went with its
// scene are no rows.
std::vector<SubjectRef> changedRows(const Database& index, const Where& where, const std::vector<std::int64_t>& runs) {
  Statement all = index.prepare(
      "SELECT s.id, s.scene, s.view, s.material, s.ordinal, c.id FROM (SELECT subject, max(run) AS last FROM event "
      "JOIN run ON run.id=event.run WHERE run>=? AND branch=? GROUP BY subject) JOIN subject AS s ON s.id=subject JOIN "
      "subject AS c ON c.suite=s.suite AND "
      "c.scene=s.scene AND c.ordinal=-2 WHERE s.suite=? AND s.ordinal!=-2 ORDER BY last DESC, s.id LIMIT ?");
  all.bind(runs.empty() ? std::int64_t{0} : runs.front(), where.branch.value_or(""), where.suite.value_or(""),
           kMostRows);
  std::vector<SubjectRef> rows;
  while (all.step())
    rows.push_back({all.integer(0), all.integer(5), where.suite.value_or(""), all.text(1), all.text(2), all.text(3),
                    static_cast<int>(all.integer(4))});
  return rows;
}

void writeRows(base::JsonWriter& json, const Database& index, const Where& where,
               const std::vector<std::int64_t>& runs) {
  const std::vector<LaneSpan> lanes = lanesOf(index, where.suite.value_or(""), where.branch);
  TrendReader reader(index, lanes);
  json.beginObject();
  for (const SubjectRef& row : changedRows(index, where, runs)) {
    json.key(row.path()).beginObject();
    writeTrend(json, reader.read(row.id, row.sceneId), runs);
    json.endObject();
  }
  json.endObject();
}

void writeTimings(base::JsonWriter& json, const Database& index, const Where& where,
                  const std::vector<std::int64_t>& runs) {
  json.beginArray();
  for (const TimingStep& step : timingSteps(index, where, kMostTimedRuns)) {
    const auto run = std::ranges::find(runs, step.now.id);
    if (run == runs.end()) continue;
    json.beginObject();
    json.key("scene").text(step.scene);
    json.key("machine").text(step.machine);
    json.key("run").integer(run - runs.begin());
    json.key("beforeMs").number(step.beforeMs);
    json.key("nowMs").number(step.nowMs);
    json.endObject();
  }
  json.endArray();
}

} // namespace

std::string nightsPageJson(const Database& index, const Where& given, std::size_t last) {
  const Where where = settled(index, given);
  const std::vector<Night> nights = nightsOf(index, where, last);
  std::vector<std::int64_t> runs;
  for (const Night& night : nights) runs.push_back(night.run.id);
  const std::map<std::int64_t, WorstRow> worst =
      worstRows(index, where.suite.value_or(""), where.branch.value_or(""), "flip.mean");
  base::JsonWriter json(base::JsonLayout::compact);
  json.beginObject();
  json.key("format").integer(kPageFormat);
  json.key("version").text(base::kVersion);
  json.key("suite").text(where.suite.value_or(""));
  json.key("branch").text(where.branch.value_or(""));
  json.key("statistics").beginObject();
  Statement metrics = index.prepare("SELECT name, better FROM metric ORDER BY id");
  while (metrics.step()) {
    json.key(metrics.text(0)).beginObject();
    json.key("better").text(metrics.text(1));
    json.endObject();
  }
  json.endObject();
  json.key("runs").beginArray();
  for (const Night& night : nights) {
    const auto found = worst.find(night.run.id);
    writeNight(json, index, night, found == worst.end() ? nullptr : &found->second);
  }
  json.endArray();
  writeRows(json.key("rows"), index, where, runs);
  writeTimings(json.key("timings"), index, where, runs);
  json.endObject();
  std::string text = json.finish();
  text.pop_back(); // the line feed
  return text;
}

std::string toNightsPage(const Database& index, const Where& given, std::size_t last) {
  if (!report::hasDashboard()) return "";
  const Where where = settled(index, given);
  const std::string json = nightsPageJson(index, where, last);
  const std::vector<Night> newest = nightsOf(index, where, 1);
  const std::string suite = where.suite.value_or("");
  return report::toHtml(
      report::DataPage{.tool = "parity history",
                       .title = fmt::format("{}nights{}", suite.empty() ? "" : suite + ": ",
                                            where.branch.value_or("").empty() ? "" : " of " + *where.branch),
                       .verdict = newest.empty() ? "" : newest.front().run.verdict,
                       .sub = newest.empty() ? "no run" : "to " + newest.front().run.started,
                       .plain = "<p>This page needs JavaScript; parity history show prints its runs.</p>\n",
                       .blocks = {{"nights", json}},
                       .files = {}});
}

} // namespace parity::history
