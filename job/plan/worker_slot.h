// A worker process as its supervisor sees it: what it does, what it says, why it ends.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/process.h"
#include "job/plan/worker.h"

namespace parity::job {

struct SuperviseOptions;

// A place for a worker, and the one that is there now, if any.
struct WorkerSlot {
  using Clock = std::chrono::steady_clock; // the time of day may jump

  std::unique_ptr<StagePage> page;
  std::unique_ptr<base::ChildProcess> process;
  std::optional<std::size_t> unit; // that it has been given and not finished
  bool isReady = false, isAlone = false, isCareful = false, isRetiring = false;
  int scenes = 0;          // that it has been given
  Clock::time_point born;  // when it was started
  Clock::time_point since; // when it was given the unit, was ready, or was told to end
  std::string fault;       // why it is ended: "took longer than ..."

  // Puts a new worker there. Throws Error where no process can be started.
  void start(const SuperviseOptions& options, bool alone);
  // Gives it a unit, or tells it that there is no more.
  void give(std::size_t unit);
  void retire();
  // What it has written to its standard output. Its stderr is kept for describe(), and shown where that is asked for.
  std::vector<std::string> listen(bool showErrors);
  // Ends it where it takes too long or too much: SIGTERM, then SIGKILL.
  void watch(const SuperviseOptions& options);
  // Nothing while it runs. One that cannot be killed counts as ended.
  std::optional<base::ProcessEnd> end();

  double secondsOf(Clock::time_point then) const { return std::chrono::duration<double>(Clock::now() - then).count(); }
  // "crashed with SIGSEGV at 'surface'; its last lines: ..."
  std::string describe(const base::ProcessEnd& end) const;
  std::string lastLine() const { return m_lastLines.empty() ? std::string() : m_lastLines.back(); }
  // Whether it ended as one that was told to, by somebody else than its supervisor.
  bool wasToldToEnd(const base::ProcessEnd& end) const;

private:
  void kill();

  std::optional<Clock::time_point> m_killAt;   // after SIGTERM
  std::optional<Clock::time_point> m_killedAt; // by SIGKILL
  std::deque<std::string> m_lastLines;
};

} // namespace parity::job
