#include "history/nights.h"

#include <algorithm>

namespace parity::history {

std::vector<Night> nightsOf(const Database& index, const Where& where, std::size_t most) {
  Statement all =
      index.prepare("SELECT id, name, started, branch, commit_id, verdict, suite, machine, complete, whole, row_count, "
                    "failed, warned, before IS NULL, version, build, device FROM run "
                    "WHERE (?1 IS NULL OR suite=?2) AND (?3 IS NULL OR branch=?4) ORDER BY id DESC LIMIT ?5");
  const auto given = [](const std::optional<std::string>& text) {
    return text ? std::optional<std::int64_t>(1) : std::nullopt;
  };
  all.bind(given(where.suite), where.suite.value_or(""), given(where.branch), where.branch.value_or(""),
           most == 0 ? std::int64_t{-1} : static_cast<std::int64_t>(most));
  std::vector<Night> nights;
  while (all.step()) {
    Night& night = nights.emplace_back();
    night.run = {all.integer(0), all.text(1), all.text(2), all.text(3), all.text(4), all.text(5)};
    night.suite = all.text(6), night.machine = all.text(7);
    night.isComplete = all.integer(8) != 0, night.isWhole = all.integer(9) != 0;
    night.rows = static_cast<std::size_t>(all.integer(10)), night.failed = static_cast<std::size_t>(all.integer(11));
    night.warned = static_cast<std::size_t>(all.integer(12));
    night.isFirst = all.integer(13) != 0;
    night.version = all.text(14), night.build = all.text(15), night.device = all.text(16);
  }
  std::ranges::reverse(nights);
  Statement events = index.prepare("SELECT kind, count(*) FROM event WHERE run=? GROUP BY kind");
  Statement times = index.prepare("SELECT count(*), sum(cached), sum(CASE WHEN cached THEN NULL ELSE cpu_ms END), "
                                  "sum(CASE WHEN cached THEN NULL ELSE wall_ms END) FROM timing WHERE run=? AND "
                                  "stage='scene'");
  constexpr double kMs = 1000;
  for (Night& night : nights) {
    times.bind(night.run.id);
    times.step();
    night.scenes = static_cast<std::size_t>(times.integer(0));
    night.cachedScenes = static_cast<std::size_t>(times.integer(1));
    night.cpuS = times.real(2) / kMs, night.wallS = times.real(3) / kMs;
    events.bind(night.run.id);
    while (events.step()) night.events[events.text(0)] = static_cast<std::size_t>(events.integer(1));
  }
  return nights;
}

std::vector<Event> eventsOf(const Database& index, std::int64_t run, const std::string& kind) {
  Statement all = index.prepare(
      "SELECT subject.id, scene, view, material, ordinal, kind, cause, metric.name, before, after, changed FROM event "
      "JOIN subject ON subject.id=event.subject LEFT JOIN metric ON metric.id=event.metric "
      "WHERE run=?1 AND (?2='' OR kind=?2) ORDER BY event.id");
  all.bind(run, kind);
  std::vector<Event> events;
  while (all.step()) {
    const SubjectRef subject{
        all.integer(0), 0, {}, all.text(1), all.text(2), all.text(3), static_cast<int>(all.integer(4))};
    events.push_back({subject.path(), all.text(5), all.text(6), all.text(7), all.real(8), all.real(9),
                      static_cast<std::size_t>(all.integer(10))});
  }
  return events;
}

} // namespace parity::history
