#include "history/subject.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/nearest.h"
#include "history/index.h"

namespace parity::history {

namespace {

// As SubjectRef::path() makes it.
constexpr const char* kPath =
    "CASE ordinal WHEN -2 THEN scene WHEN -1 THEN scene||'/'||view ELSE scene||'/'||view||'/'||material||"
    "CASE WHEN ordinal>0 THEN ' ('||(ordinal+1)||')' ELSE '' END END";

std::string newestSuite(const Database& index) {
  Statement find = index.prepare("SELECT suite FROM run WHERE lane IS NOT NULL ORDER BY id DESC LIMIT 1");
  return find.step() ? find.text(0) : std::string();
}

[[noreturn]] void refuse(const Database& index, const std::string& path, const std::string& suite) {
  std::vector<std::string> names;
  Statement all = index.prepare(fmt::format("SELECT {} FROM subject WHERE suite=?", kPath));
  all.bind(suite);
  while (all.step()) names.push_back(all.text(0));
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw base::Error(base::ExitCode::usage, path, "",
                    fmt::format("the history has no such scene, SCENE/VIEW or SCENE/VIEW/MATERIAL{}; {}",
                                suite.empty() ? "" : fmt::format(" of the suite '{}'", suite),
                                base::describeNearest(path, known)));
}

bool isSame(const Interval& a, const Interval& b) {
  return (a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))) && a.verdict == b.verdict &&
         a.rule == b.rule;
}

// read: those of a lane, oldest first, as the index has them: the last run of one that still is is 0.
std::vector<Interval> intervals(const std::vector<LaneSpan>& lanes,
                                const std::function<std::vector<Interval>(std::int64_t lane)>& read) {
  std::vector<Interval> all;
  std::int64_t endOfOlder = 0; // lane: what lasts until then may go on in the next one
  for (auto span = lanes.rbegin(); span != lanes.rend(); ++span) {
    for (Interval& each : read(span->lane)) {
      if (each.firstRun > span->lastRun) break;
      if (each.lastRun == 0 || each.lastRun > span->lastRun) each.lastRun = span->lastRun;
      if (!all.empty() && all.back().lastRun == endOfOlder && isSame(all.back(), each))
        all.back().lastRun = each.lastRun;
      else
        all.push_back(std::move(each));
    }
    endOfOlder = span->lastRun;
  }
  for (Interval& each : all) each.isNow = each.lastRun == endOfOlder;
  return all;
}

} // namespace

std::string SubjectRef::path() const {
  if (ordinal == kScene) return scene;
  if (ordinal == kWhole) return scene + "/" + view;
  return fmt::format("{}/{}/{}{}", scene, view, material, ordinal > 0 ? fmt::format(" ({})", ordinal + 1) : "");
}

Where settled(const Database& index, const Where& where) {
  Where settled{where.suite ? *where.suite : newestSuite(index), where.branch};
  if (settled.branch) return settled;
  Statement newest = index.prepare("SELECT branch FROM run WHERE suite=? ORDER BY id DESC LIMIT 1");
  if (newest.bind(*settled.suite).step()) settled.branch = newest.text(0);
  return settled;
}

SubjectRef findSubject(const Database& index, const std::string& path, const Where& where) {
  const std::string suite = where.suite ? *where.suite : newestSuite(index);
  Statement find = index.prepare(
      fmt::format("SELECT id, scene, view, material, ordinal FROM subject WHERE suite=? AND {}=? LIMIT 1", kPath));
  if (!find.bind(suite, path).step()) refuse(index, path, suite);
  SubjectRef subject{
      find.integer(0), 0, suite, find.text(1), find.text(2), find.text(3), static_cast<int>(find.integer(4))};
  Statement scene = index.prepare("SELECT id FROM subject WHERE suite=? AND scene=? AND ordinal=?");
  subject.sceneId = scene.bind(suite, subject.scene, kScene).step() ? scene.integer(0) : subject.id;
  return subject;
}

RunRef findRun(const Database& index, std::int64_t id) {
  Statement find = index.prepare("SELECT name, started, branch, commit_id, verdict FROM run WHERE id=?");
  if (!find.bind(id).step()) return {id, {}, {}, {}, {}, {}};
  return {id, find.text(0), find.text(1), find.text(2), find.text(3), find.text(4)};
}

std::vector<LaneSpan> lanesUpTo(const Database& index, std::int64_t run) {
  std::vector<LaneSpan> lanes;
  Statement lane = index.prepare("SELECT lane FROM run WHERE id=? AND lane IS NOT NULL");
  if (!lane.bind(run).step()) return lanes;
  lanes.push_back({lane.integer(0), run});
  Statement first =
      index.prepare("SELECT before, (SELECT lane FROM run AS b WHERE b.id=run.before) FROM run WHERE lane=? "
                    "ORDER BY id LIMIT 1");
  for (;;) {
    if (!first.bind(lanes.back().lane).step() || first.isNull(0)) return lanes;
    const LaneSpan older{first.integer(1), first.integer(0)};
    if (std::ranges::any_of(lanes, [&](const LaneSpan& each) { return each.lane == older.lane; })) return lanes;
    lanes.push_back(older);
  }
}

std::vector<LaneSpan> lanesOf(const Database& index, const std::string& suite,
                              const std::optional<std::string>& branch) {
  Statement newest = index.prepare("SELECT id FROM run WHERE suite=?1 AND (?2 IS NULL OR branch=?3) AND lane IS NOT "
                                   "NULL ORDER BY id DESC LIMIT 1");
  newest.bind(suite, branch ? std::optional<std::int64_t>(1) : std::nullopt, branch.value_or(""));
  return newest.step() ? lanesUpTo(index, newest.integer(0)) : std::vector<LaneSpan>();
}

std::vector<Interval> statesOf(const Database& index, const std::vector<LaneSpan>& lanes, std::int64_t subject) {
  Statement all = index.prepare(
      "SELECT first_run, last_run, verdict, reason, rule FROM state WHERE lane=? AND subject=? ORDER BY first_run");
  return intervals(lanes, [&](std::int64_t lane) {
    std::vector<Interval> some;
    all.bind(lane, subject);
    while (all.step())
      some.push_back({all.integer(0), all.integer(1), false, 0, all.text(2), all.text(3), all.text(4)});
    return some;
  });
}

std::vector<Course> coursesOf(const Database& index, const std::vector<LaneSpan>& lanes, std::int64_t subject) {
  using Values = std::map<std::int64_t, std::vector<Interval>>;   // by lane
  std::map<std::int64_t, std::pair<std::string, Values>> figures; // by metric
  Statement all = index.prepare("SELECT metric, name, first_run, last_run, v FROM value JOIN metric ON "
                                "metric.id=value.metric WHERE lane=? AND subject=? ORDER BY metric, first_run");
  for (const LaneSpan& span : lanes) {
    all.bind(span.lane, subject);
    while (all.step()) {
      auto& [name, values] = figures[all.integer(0)];
      name = all.text(1);
      values[span.lane].push_back({all.integer(2), all.integer(3), false, all.real(4), {}, {}, {}});
    }
  }
  std::vector<Course> courses;
  for (auto& [metric, figure] : figures)
    courses.push_back(
        {metric, figure.first, intervals(lanes, [&](std::int64_t lane) { return std::move(figure.second[lane]); })});
  return courses;
}

} // namespace parity::history
