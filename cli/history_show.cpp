// parity history show and blame.
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/text/text.h"
#include "cli/history_parts.h"
#include "cli/output.h"
#include "history/blame.h"
#include "history/nights.h"
#include "history/nights_page.h"
#include "history/store.h"
#include "history/timing_steps.h"

namespace parity::cli {

namespace {

using history::Store;
using nlohmann::ordered_json;

constexpr std::size_t kShownCommit = 12;

std::string shownCommit(const std::string& commit) {
  return commit.empty() ? "no commit" : commit.substr(0, kShownCommit);
}

ordered_json jsonValue(double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); }

ordered_json toJson(const history::RunRef& run) {
  return {{"run", run.name},
          {"started", run.started},
          {"branch", run.branch},
          {"commit", run.commit},
          {"verdict", run.verdict}};
}

void printNights(const std::vector<history::Night>& nights) {
  for (const history::Night& night : nights) {
    const std::string kind = !night.isWhole ? "a part; " : !night.isComplete ? "incomplete; " : "";
    print("{}  {:<12} {:<10} {:<6} {:>6} rows {:>5} fail {:>5} warn  {}{}\n", night.run.name,
          shownCommit(night.run.commit), base::plainLine(night.run.branch), night.run.verdict, night.rows, night.failed,
          night.warned, kind,
          !night.isWhole  ? "not compared"
          : night.isFirst ? "first of its suite and branch"
                          : describeEvents(night.events));
  }
}

std::string nightsJson(const std::vector<history::Night>& nights) {
  ordered_json list = ordered_json::array();
  for (const history::Night& night : nights) {
    ordered_json json = toJson(night.run);
    json["suite"] = night.suite, json["machine"] = night.machine;
    json["complete"] = night.isComplete, json["whole"] = night.isWhole;
    json["rows"] = night.rows, json["failed"] = night.failed, json["warned"] = night.warned;
    json["events"] = night.events;
    list.push_back(std::move(json));
  }
  return dumpJson(list);
}

std::string describe(const history::Course& course, const history::Interval& each) {
  return course.name == "verdict" ? each.verdict : shownValue(each.value);
}

void printCourses(const history::Database& index, const history::SubjectRef& subject,
                  const std::vector<history::Course>& courses) {
  print("{}\n", base::plainLine(subject.path()));
  for (const history::Course& course : courses)
    for (const history::Interval& each : course.values) {
      const bool isFirst = &each == &course.values.front();
      const history::RunRef first = history::findRun(index, each.firstRun),
                            last = history::findRun(index, each.lastRun);
      print("  {:<24} {:<10} {} .. {}{}\n", isFirst ? course.name : "", describe(course, each), first.started,
            each.isNow ? "now" : last.started, each.reason.empty() ? "" : "  " + base::plainLine(each.reason));
    }
}

std::string coursesJson(const history::Database& index, const history::SubjectRef& subject,
                        const std::vector<history::Course>& courses) {
  ordered_json json = {{"subject", subject.path()}, {"suite", subject.suite}, {"courses", ordered_json::object()}};
  for (const history::Course& course : courses) {
    ordered_json list = ordered_json::array();
    for (const history::Interval& each : course.values) {
      ordered_json interval = {{"first", toJson(history::findRun(index, each.firstRun))},
                               {"last", toJson(history::findRun(index, each.lastRun))},
                               {"now", each.isNow}};
      if (course.name == "verdict")
        interval["verdict"] = each.verdict, interval["reason"] = each.reason, interval["rule"] = each.rule;
      else
        interval["value"] = jsonValue(each.value);
      list.push_back(std::move(interval));
    }
    json["courses"][course.name] = std::move(list);
  }
  return dumpJson(json);
}

std::string timingsJson(const std::vector<history::TimingStep>& steps) {
  ordered_json list = ordered_json::array();
  for (const history::TimingStep& step : steps)
    list.push_back({{"scene", step.scene},
                    {"machine", step.machine},
                    {"before", toJson(step.before)},
                    {"now", toJson(step.now)},
                    {"beforeMs", step.beforeMs},
                    {"nowMs", step.nowMs}});
  return dumpJson(list);
}

void printTimings(const std::vector<history::TimingStep>& steps) {
  if (steps.empty()) print("no CPU time of a scene has a step\n");
  for (const history::TimingStep& step : steps) {
    constexpr double kPercent = 100;
    print("{}: {:.0f} ms -> {:.0f} ms ({:+.0f} %)  {} .. {}  {}..{}  {}\n", base::plainLine(step.scene), step.beforeMs,
          step.nowMs, kPercent * (step.nowMs / step.beforeMs - 1), step.before.started, step.now.started,
          shownCommit(step.before.commit), shownCommit(step.now.commit), base::plainLine(step.machine));
  }
}

} // namespace

int showHistory(const HistoryShowCommand& command) {
  const Store store(command.folder, Store::For::reading);
  if (command.timings) {
    const std::vector<history::TimingStep> steps =
        history::timingSteps(store.index(), history::settled(store.index(), command.where), history::kMostTimedRuns);
    if (!command.json.empty()) writeJson(command.json, timingsJson(steps));
    if (command.json != "-") printTimings(steps);
    return 0;
  }
  if (command.subject.empty()) {
    const std::vector<history::Night> nights =
        history::nightsOf(store.index(), history::settled(store.index(), command.where), command.last);
    if (!command.json.empty()) writeJson(command.json, nightsJson(nights));
    if (command.json != "-") printNights(nights);
    return 0;
  }
  const history::SubjectRef subject = history::findSubject(store.index(), command.subject, command.where);
  const std::vector<history::LaneSpan> lanes = history::lanesOf(store.index(), subject.suite, command.where.branch);
  std::vector<history::Course> courses = history::coursesOf(store.index(), lanes, subject.id);
  courses.insert(courses.begin(), {0, "verdict", history::statesOf(store.index(), lanes, subject.id)});
  if (!command.json.empty()) writeJson(command.json, coursesJson(store.index(), subject, courses));
  if (command.json != "-") printCourses(store.index(), subject, courses);
  return 0;
}

namespace {

std::string blameJson(const history::Blame& blame) {
  ordered_json json = {{"subject", blame.subject.path()},
                       {"suite", blame.subject.suite},
                       {"changed", blame.isChanged},
                       {"runs", blame.runs}};
  if (blame.isChanged) {
    json["kind"] = blame.kind;
    json["before"] = toJson(blame.before), json["now"] = toJson(blame.now);
    json["verdictBefore"] = blame.verdictBefore, json["verdict"] = blame.verdictNow;
    json["figures"] = ordered_json::array(), json["inputs"] = ordered_json::array();
    for (const history::FigureStep& each : blame.figures)
      json["figures"].push_back(
          {{"metric", each.metric}, {"before", jsonValue(each.before)}, {"now", jsonValue(each.now)}});
    for (const history::InputStep& each : blame.inputs)
      json["inputs"].push_back({{"what", each.what}, {"before", each.before}, {"now", each.now}});
    json["nondeterministic"] = blame.isNondeterministic;
  }
  return dumpJson(json);
}

// Digests by their first digits.
std::string shownInput(const std::string& text) {
  constexpr std::size_t kInputs = 12, kDigest = 32, kShown = 8; // of a scene's inputs; of a build
  const bool isDigest = (text.size() == kInputs || text.size() == kDigest) &&
                        text.find_first_not_of("0123456789abcdef") == std::string::npos;
  return text.empty() ? "none" : isDigest ? text.substr(0, kShown) : base::plainLine(text);
}

void printBlame(const history::Blame& blame) {
  const std::string runs = fmt::format("{} run{}", blame.runs, blame.runs == 1 ? "" : "s");
  if (!blame.isChanged)
    return print("{}: did not change in {} since {} ({})\n", base::plainLine(blame.subject.path()), runs,
                 blame.first.started, shownCommit(blame.first.commit));
  print("{}: {}, {} since then\n", base::plainLine(blame.subject.path()), blame.kind.empty() ? "changed" : blame.kind,
        runs);
  if (blame.verdictBefore != blame.verdictNow) print("  verdict   {} -> {}\n", blame.verdictBefore, blame.verdictNow);
  for (const history::FigureStep& each : blame.figures)
    print("  {:<9} {} -> {}\n", each.metric, shownValue(each.before), shownValue(each.now));
  print("  runs      {} .. {}\n", blame.before.name, blame.now.name);
  const std::string &from = blame.before.commit, &to = blame.now.commit;
  if (from == to)
    print("  commits   {} in both\n", shownCommit(to));
  else
    print("  commits   {}..{}\n", shownCommit(from), shownCommit(to));
  for (const history::InputStep& each : blame.inputs)
    print("  {:<9} {} -> {}\n", each.what, shownInput(each.before), shownInput(each.now));
  if (blame.isNondeterministic) print("  cause     nothing that decides figures changed: nondeterminism\n");
}

} // namespace

int blameHistory(const HistoryBlameCommand& command) {
  const Store store(command.folder, Store::For::reading);
  const history::Blame blame = history::blame(store.index(), command.subject, command.metric, command.where);
  if (!command.json.empty()) writeJson(command.json, blameJson(blame));
  if (command.json != "-") printBlame(blame);
  return 0;
}

} // namespace parity::cli
