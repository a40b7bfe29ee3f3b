#include "history/blame.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text/nearest.h"
#include "history/index.h"

namespace parity::history {

namespace {

// The runs on both sides of a change; 0: none.
struct Place {
  std::int64_t before = 0, now = 0;
};

Place lastChangeOf(const std::vector<Interval>& intervals) {
  if (intervals.size() < 2) return {};
  return {intervals[intervals.size() - 2].lastRun, intervals.back().firstRun};
}

const Interval* at(const std::vector<Interval>& intervals, std::int64_t run) {
  for (const Interval& each : intervals)
    if (each.firstRun <= run && run <= each.lastRun) return &each;
  return nullptr;
}

std::vector<Course> chosenCourses(const Database& index, const std::vector<LaneSpan>& lanes, std::int64_t subject,
                                  const std::string& metric) {
  std::vector<Course> courses = coursesOf(index, lanes, subject);
  if (metric.empty()) return courses;
  const auto found = std::ranges::find(courses, metric, &Course::name);
  if (found != courses.end()) return {*found};
  std::vector<std::string_view> known;
  for (const Course& each : courses) known.push_back(each.name);
  throw base::Error(base::ExitCode::usage, "--metric", metric,
                    "the history has no such figure of it; " + base::describeNearest(metric, known));
}

// Of a run, and of a scene in it: what the index has of the lane up to that run.
std::vector<std::string> inputsAt(const Database& index, std::int64_t run, std::int64_t scene) {
  constexpr int kOfScene = 5;
  std::vector<std::string> values(kOfScene);
  Statement input =
      index.prepare("SELECT asset, environment, request, bake, pictures FROM input WHERE lane=(SELECT lane FROM run "
                    "WHERE id=?1) AND scene=?2 AND first_run<=?1 ORDER BY first_run DESC LIMIT 1");
  if (input.bind(run, scene).step())
    for (int i = 0; i < kOfScene; ++i) values[static_cast<std::size_t>(i)] = input.text(i);
  Statement makers =
      index.prepare("SELECT build, device, driver, numerics, settings, version, budgets, machine FROM run WHERE id=?");
  const bool isThere = makers.bind(run).step();
  for (int i = 0; i < 8; ++i) values.push_back(isThere ? makers.text(i) : std::string());
  return values;
}

constexpr const char* kInputNames[] = {"asset",  "environment", "request",  "bake",    "pictures", "build",  "device",
                                       "driver", "numerics",    "settings", "version", "budgets",  "machine"};
constexpr std::size_t kDeciding = 10; // the first ones decide figures

void findInputs(const Database& index, Blame& blame) {
  const std::vector<std::string> before = inputsAt(index, blame.before.id, blame.subject.sceneId),
                                 now = inputsAt(index, blame.now.id, blame.subject.sceneId);
  bool isExplained = false;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] != now[i]) {
      blame.inputs.push_back({kInputNames[i], before[i], now[i]});
      isExplained = isExplained || i < kDeciding;
    }
  blame.isNondeterministic = !blame.figures.empty() && !isExplained;
}

std::size_t countRuns(const Database& index, const std::vector<LaneSpan>& lanes, std::int64_t from, std::int64_t to) {
  Statement count = index.prepare("SELECT count(*) FROM run WHERE lane=? AND id BETWEEN ? AND ?");
  std::int64_t runs = 0;
  for (const LaneSpan& span : lanes)
    if (count.bind(span.lane, from, std::min(to, span.lastRun)).step()) runs += count.integer(0);
  return static_cast<std::size_t>(runs);
}

std::string kindAt(const Database& index, std::int64_t run, std::int64_t subject) {
  Statement find = index.prepare("SELECT kind FROM event WHERE run=? AND subject=? ORDER BY id LIMIT 1");
  return find.bind(run, subject).step() ? find.text(0) : std::string();
}

} // namespace

Blame blame(const Database& index, const std::string& path, const std::string& metric, const Where& where) {
  Blame blame;
  blame.subject = findSubject(index, path, where);
  const std::vector<LaneSpan> lanes = lanesOf(index, blame.subject.suite, where.branch);
  const std::vector<Interval> states = statesOf(index, lanes, blame.subject.id);
  if (states.empty())
    throw base::Error(base::ExitCode::usage, path, "",
                      fmt::format("no whole run of {} shows it",
                                  where.branch ? "branch '" + *where.branch + "'" : "the newest branch"));
  blame.first = findRun(index, states.front().firstRun);
  blame.newest = findRun(index, states.back().lastRun);
  const std::vector<Course> courses = chosenCourses(index, lanes, blame.subject.id, metric);
  Place place = metric.empty() ? lastChangeOf(states) : Place{};
  for (const Course& each : courses)
    if (const Place other = lastChangeOf(each.values); other.now > place.now) place = other;
  blame.isChanged = place.now != 0;
  blame.runs = countRuns(index, lanes, blame.isChanged ? place.now : blame.first.id, blame.newest.id);
  if (!blame.isChanged) return blame;
  blame.before = findRun(index, place.before), blame.now = findRun(index, place.now);
  for (const Course& each : courses) {
    const Interval *then = at(each.values, place.before), *here = at(each.values, place.now);
    if (then && here && then != here) blame.figures.push_back({each.name, then->value, here->value});
  }
  if (const Interval* then = at(states, place.before)) blame.verdictBefore = then->verdict;
  if (const Interval* here = at(states, place.now)) blame.verdictNow = here->verdict;
  blame.kind = kindAt(index, place.now, blame.subject.id);
  findInputs(index, blame);
  return blame;
}

} // namespace parity::history
