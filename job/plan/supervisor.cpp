#include "job/plan/supervisor.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <poll.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "job/plan/unit_store.h"
#include "job/plan/worker_slot.h"
#include "job/scene/scene_start.h"

namespace parity::job {

namespace {

constexpr double kMostBatchS = 60, kLookS = 0.05;
constexpr std::chrono::seconds kGraceS{5}; // for the workers' end
constexpr int kMostStarts = 3;             // that fail in a row
constexpr int kMostTold = 2; // times that somebody else ends the workers of a unit before that counts as a crash

class Supervisor {
public:
  Supervisor(const Plan& plan, const std::filesystem::path& folder, const std::vector<std::size_t>& units,
             const SuperviseOptions& options, const Progress& progress)
      : m_plan(plan), m_store(folder, plan), m_options(options), m_progress(progress), m_total(units.size()),
        m_slots(static_cast<std::size_t>(std::max(options.jobs, 1))) {
    for (const std::size_t unit : units) (m_store.wasBegun(unit) ? m_begun : m_queue).push_back(unit);
  }

  SuperviseResult run() {
    while (!m_isOver && isBusy()) {
      if (m_options.stoppedBy && m_options.stoppedBy() != 0) {
        m_result.why = fmt::format("{} ended the work", base::signalName(m_options.stoppedBy()));
        break;
      }
      for (WorkerSlot& slot : m_slots) step(slot);
      wait();
    }
    endAll();
    if (!m_isDead && m_result.why.empty()) keepFailures();
    m_result.missing = m_total - m_result.done;
    return m_result;
  }

private:
  bool isBusy() const {
    return !m_queue.empty() || !m_again.empty() || !m_begun.empty() ||
           std::ranges::any_of(m_slots, [](const WorkerSlot& slot) { return slot.process != nullptr; });
  }

  void step(WorkerSlot& slot) {
    if (!slot.process && !m_isOver) start(slot);
    if (!slot.process) return;
    const std::optional<base::ProcessEnd> end = slot.end(); // first: what is read then is all
    listen(slot);
    if (end)
      bury(slot, *end);
    else if (slot.isReady && !slot.unit)
      giveNext(slot);
    else
      slot.watch(m_options);
  }

  void start(WorkerSlot& slot) {
    const auto count = [&](auto holds) { return static_cast<std::size_t>(std::ranges::count_if(m_slots, holds)); };
    // Those that are there already for what is to be tried again.
    const std::size_t others = count([](const WorkerSlot& s) { return s.process && s.isAlone && s.scenes == 0; });
    // What was begun before and not finished may have taken the whole machine down: it has it for itself, at the end.
    const bool isAnyBusy = count([](const WorkerSlot& s) { return s.process != nullptr; }) > 0;
    const bool isAlone = m_again.size() > others, isCareful = !isAlone && m_queue.empty() && !m_begun.empty();
    if (isCareful ? isAnyBusy : !isAlone && m_queue.empty()) return;
    try {
      slot.start(m_options, isAlone);
      slot.isCareful = isCareful;
    } catch (const base::Error& error) { // too many processes or open files
      m_isDead = true;
      stopAll(error.what());
    }
  }

  std::deque<std::size_t>& queueOf(const WorkerSlot& slot) {
    return slot.isAlone ? m_again : slot.isCareful ? m_begun : m_queue;
  }

  void giveNext(WorkerSlot& slot) {
    if (slot.isRetiring || !slot.fault.empty()) return slot.watch(m_options);
    std::deque<std::size_t>& queue = queueOf(slot);
    const bool isFull = slot.isAlone || slot.isCareful
                            ? slot.scenes > 0
                            : slot.scenes >= kMostScenes || slot.secondsOf(slot.born) > kMostBatchS;
    if (queue.empty() || isFull) return slot.retire();
    m_store.noteBegun(queue.front());
    slot.give(queue.front());
    queue.pop_front();
  }

  void listen(WorkerSlot& slot) {
    for (const std::string& line : slot.listen(m_options.showErrors)) {
      if (line == kReadyLine) {
        slot.isReady = true;
        slot.since = WorkerSlot::Clock::now();
      } else if (slot.unit && line == doneLine(*slot.unit)) {
        finish(slot);
      }
    }
    if (m_progress && slot.unit)
      m_progress(fmt::format("{} of {} done, {}: {}", m_result.done, m_total, nameOf(*slot.unit), slot.page->get()),
                 static_cast<double>(m_result.done) / static_cast<double>(m_total));
  }

  void finish(WorkerSlot& slot) {
    ++m_result.done;
    m_failedStarts = 0;
    m_store.forgetBegun(*slot.unit);
    keepFailures();
    base::logDetail(fmt::format("{}: done in {:.1f} s", nameOf(*slot.unit), slot.secondsOf(slot.since)));
    if (const auto crash = m_attempts.find(*slot.unit); crash != m_attempts.end())
      base::logWarning(fmt::format("{}: flaky crash: {}; the second try succeeded", nameOf(*slot.unit), crash->second));
    slot.unit.reset();
  }

  void bury(WorkerSlot& slot, const base::ProcessEnd& end) {
    const std::optional<std::size_t> unit = slot.unit;
    const auto isCode = [&](base::ExitCode code) { return end.signal == 0 && end.exitCode == static_cast<int>(code); };
    const std::string words = slot.describe(end);
    const bool isBad = end.signal != 0 || end.exitCode != 0, isAlone = slot.isAlone;
    const bool hasStarted = slot.scenes > 0 || (slot.isReady && !isBad);
    const bool wasToldToEnd = slot.wasToldToEnd(end), wasEnded = !slot.fault.empty();
    std::deque<std::size_t>& queue = queueOf(slot);
    const std::string lastLine = slot.lastLine().empty() ? words : slot.lastLine();
    slot = {};
    if (isCode(base::ExitCode::otherPlan) || isCode(base::ExitCode::incomplete)) {
      m_result.otherPlan |= isCode(base::ExitCode::otherPlan);
      stopAll(lastLine);
    } else if (!hasStarted) {
      if (++m_failedStarts < kMostStarts) return;
      m_isDead = true;
      stopAll("no worker can start: " + (wasEnded ? "it " + words : lastLine));
    } else if (unit && wasToldToEnd && ++m_told[*unit] <= kMostTold) { // as a scheduler tells all processes of a job
      queue.push_front(*unit);
    } else if (unit) {
      fail(*unit, words, isAlone);
    } else if (isBad) {
      base::logDetail("a worker ended badly after its work was done: " + words);
    }
  }

  void fail(std::size_t unit, const std::string& words, bool wasAlone) {
    if (!wasAlone) {
      m_attempts[unit] = words;
      tryToWrite([&] { m_store.noteCrash(unit, words); });
      m_again.push_back(unit);
      base::logDetail(fmt::format("{}: {}; it is tried once more", nameOf(unit), words));
    } else {
      m_failures.emplace_back(unit, words);
    }
    if (++m_failuresInARow >= kMostFailures) {
      m_isDead = true;
      stopAll(fmt::format("{} workers failed in a row, so the device is taken for dead; the last one {}", kMostFailures,
                          words));
    }
  }

  // Once a worker succeeds, those that failed before were not the device's fault.
  void keepFailures() {
    m_failuresInARow = 0;
    for (const auto& [unit, words] : std::exchange(m_failures, {})) {
      if (m_store.findFault(unit).empty()) { // another machine could, or the worker crashed behind its record
        ++m_result.done;
        continue;
      }
      const SceneRequest& request = m_plan.request.scenes[unit];
      ComparedScene scene;
      scene.result = startScene(request);
      scene.result.error = "its worker failed twice: it " + words;
      scene.result.errorExitCode = static_cast<int>(base::ExitCode::failed);
      scene.error = fmt::format("{}: {}", request.name, scene.result.error);
      if (!tryToWrite([&] { m_store.put(unit, std::move(scene), {.isGivenUp = true}); })) return;
      m_store.forgetBegun(unit);
      ++m_result.done;
      ++m_result.crashed;
      m_result.lastCrash = fmt::format("{}: it {}", request.name, words);
    }
  }

  // A full disk ends the work; it may go on later.
  bool tryToWrite(const std::function<void()>& write) {
    try {
      write();
      return true;
    } catch (const base::Error& error) {
      stopAll(error.what());
      return false;
    }
  }

  void stopAll(std::string why) {
    m_isOver = true;
    if (m_result.why.empty()) m_result.why = std::move(why);
  }

  void endAll() {
    for (const WorkerSlot& slot : m_slots)
      if (slot.process) slot.process->closeInput(), slot.process->signal(SIGTERM);
    const auto begin = WorkerSlot::Clock::now();
    while (WorkerSlot::Clock::now() - begin < kGraceS &&
           std::ranges::any_of(m_slots, [](const WorkerSlot& slot) { return slot.process && !slot.process->end(); })) {
      for (WorkerSlot& slot : m_slots)
        if (slot.process) listen(slot);
      wait();
    }
    for (WorkerSlot& slot : m_slots)
      if (slot.process) listen(slot); // a unit may be done
    m_slots.clear();                  // kills what still runs
  }

  // Until a worker says something, and not long.
  void wait() const {
    std::vector<pollfd> descriptors;
    for (const WorkerSlot& slot : m_slots)
      if (slot.process)
        for (const int descriptor : {slot.process->outputDescriptor(), slot.process->errorDescriptor()})
          descriptors.push_back({descriptor, POLLIN, 0});
    ::poll(descriptors.data(), descriptors.size(), static_cast<int>(kLookS * 1000));
    if (std::ranges::any_of(descriptors, [](const pollfd& d) { return (d.revents & POLLHUP) != 0; }))
      ::poll(nullptr, 0, 1); // it is about to end
  }

  const std::string& nameOf(std::size_t unit) const { return m_plan.request.scenes[unit].name; }

  const Plan& m_plan;
  const UnitStore m_store;
  const SuperviseOptions& m_options;
  const Progress& m_progress;
  std::deque<std::size_t> m_queue, m_again; // to be tried; to be tried once more, alone
  std::deque<std::size_t> m_begun;          // that an earlier run began: the last, one at a time
  std::map<std::size_t, int> m_told;        // how often somebody else ended a unit's worker
  std::size_t m_total;
  std::vector<WorkerSlot> m_slots;
  std::map<std::size_t, std::string> m_attempts;               // what the first worker of a unit came to
  std::vector<std::pair<std::size_t, std::string>> m_failures; // of second tries, since the last success
  int m_failuresInARow = 0, m_failedStarts = 0;
  bool m_isOver = false, m_isDead = false;
  SuperviseResult m_result;
};

} // namespace

SuperviseResult supervise(const Plan& plan, const std::filesystem::path& folder, const std::vector<std::size_t>& units,
                          const SuperviseOptions& options, const Progress& progress) {
  return Supervisor(plan, folder, units, options, progress).run();
}

} // namespace parity::job
