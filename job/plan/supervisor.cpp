#include "job/plan/supervisor.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/process.h"
#include "base/text/shown_text.h"
#include "job/plan/unit_store.h"
#include "job/plan/worker.h"
#include "job/scene/scene_start.h"

namespace parity::job {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kMostBatchS = 60, kGraceS = 5, kLookS = 0.05;
constexpr double kMostStartS = 120; // until a worker is ready, where a scene may take less
constexpr double kMostDeathS = 10;  // after SIGKILL: one that hangs in the kernel is given up
constexpr int kMostStarts = 3; // that fail in a row
constexpr std::size_t kMostLines = 8, kMostLineBytes = 300;

// One worker, and what it is at.
struct Slot {
  std::unique_ptr<StagePage> page;
  std::unique_ptr<base::ChildProcess> process;
  std::optional<std::size_t> unit; // that it has been given and not finished
  bool isReady = false, isAlone = false, isRetiring = false, isKilled = false;
  int scenes = 0;
  Clock::time_point born, since; // since: of the unit, or of the start
  Clock::time_point killAt;      // after SIGTERM
  std::string fault;             // why it is ended: "took longer than ..."
  std::deque<std::string> lastLines;
};

class Supervisor {
public:
  Supervisor(const Plan& plan, const std::filesystem::path& folder, const std::vector<std::size_t>& units,
             const SuperviseOptions& options, const Progress& progress)
      : m_plan(plan), m_store(folder, plan), m_options(options), m_progress(progress),
        m_queue(units.begin(), units.end()), m_total(units.size()),
        m_slots(static_cast<std::size_t>(std::max(options.jobs, 1))) {}

  SuperviseResult run() {
    while (!m_isOver && isBusy()) {
      if (m_options.stoppedBy && m_options.stoppedBy() != 0) {
        m_result.why = fmt::format("{} ended the work", base::signalName(m_options.stoppedBy()));
        break;
      }
      for (Slot& slot : m_slots) step(slot);
      wait();
    }
    endAll();
    if (!m_isDead) keepFailures();
    m_result.missing = m_total - m_result.done;
    return m_result;
  }

private:
  bool isBusy() const {
    return !m_queue.empty() || !m_again.empty() ||
           std::ranges::any_of(m_slots, [](const Slot& slot) { return slot.process != nullptr; });
  }

  void step(Slot& slot) {
    if (!slot.process && !m_isOver) start(slot);
    if (!slot.process) return;
    std::optional<base::ProcessEnd> end = slot.process->end(); // first: what is read then is all
    listen(slot);
    if (!end && slot.isKilled && Seconds(Clock::now() - slot.killAt).count() > kMostDeathS)
      end = base::ProcessEnd{0, SIGKILL};
    if (end)
      bury(slot, *end);
    else if (slot.isReady && !slot.unit)
      giveNext(slot);
    else
      watch(slot);
  }

  void start(Slot& slot) {
    const bool isAlone = !m_again.empty();
    if (!isAlone && m_queue.empty()) return;
    slot = {};
    try {
      slot.page = std::make_unique<StagePage>();
      slot.process = std::make_unique<base::ChildProcess>(m_options.command, slot.page->descriptor());
    } catch (const base::Error& error) { // too many processes or open files
      m_isDead = true;
      return stopAll(error.what());
    }
    slot.isAlone = isAlone;
    slot.born = slot.since = Clock::now();
  }

  void giveNext(Slot& slot) {
    if (slot.isRetiring || !slot.fault.empty()) return watch(slot);
    std::deque<std::size_t>& queue = slot.isAlone ? m_again : m_queue;
    const bool isFull = slot.isAlone ? slot.scenes > 0
                                     : slot.scenes >= kMostScenes || Seconds(Clock::now() - slot.born).count() > kMostBatchS;
    if (queue.empty() || isFull) {
      slot.isRetiring = true;
      slot.since = Clock::now();
      slot.process->closeInput();
      return;
    }
    slot.unit = queue.front();
    queue.pop_front();
    ++slot.scenes;
    slot.since = Clock::now();
    m_store.noteBegun(*slot.unit);
    slot.process->send(std::to_string(*slot.unit));
  }

  void listen(Slot& slot) {
    for (const std::string& line : slot.process->readError()) {
      slot.lastLines.push_back(base::shownText(line).substr(0, kMostLineBytes));
      if (slot.lastLines.size() > kMostLines) slot.lastLines.pop_front();
      if (m_options.showErrors || base::logLevel() == base::LogLevel::verbose) base::logPlain(line);
    }
    for (const std::string& line : slot.process->readOutput()) {
      if (line == kReadyLine) {
        slot.isReady = true;
        slot.since = Clock::now();
        m_failedStarts = 0;
      } else if (slot.unit && line == doneLine(*slot.unit)) {
        finish(slot);
      }
    }
    if (m_progress && slot.unit)
      m_progress(fmt::format("{} of {} done, {}: {}", m_result.done, m_total, nameOf(*slot.unit), slot.page->get()),
                 static_cast<double>(m_result.done) / static_cast<double>(m_total));
  }

  void finish(Slot& slot) {
    ++m_result.done;
    m_store.forgetBegun(*slot.unit);
    keepFailures();
    base::logDetail(fmt::format("{}: done in {:.1f} s", nameOf(*slot.unit), Seconds(Clock::now() - slot.since).count()));
    if (const auto crash = m_attempts.find(*slot.unit); crash != m_attempts.end())
      base::logWarning(fmt::format("{}: flaky crash: {}; the second try succeeded", nameOf(*slot.unit), crash->second));
    slot.unit.reset();
  }

  // Ends a worker that takes too long or too much.
  void watch(Slot& slot) {
    const double elapsed = Seconds(Clock::now() - slot.since).count();
    if (!slot.fault.empty()) {
      if (Clock::now() >= slot.killAt && !std::exchange(slot.isKilled, true)) slot.process->signal(SIGKILL);
      return;
    }
    if (slot.isRetiring) { // a driver that hangs at its end has done its work
      if (elapsed > kGraceS) slot.process->signal(SIGKILL);
      return;
    }
    if (elapsed > (slot.isReady ? m_options.timeoutS : std::max(m_options.timeoutS, kMostStartS)))
      slot.fault = fmt::format("took longer than {:g} s (--timeout)", m_options.timeoutS);
    else if (const std::size_t bytes = residentBytes(slot); m_options.memoryBytes > 0 && bytes > m_options.memoryBytes)
      slot.fault = fmt::format("took more than {} MiB of memory (--memory)", m_options.memoryBytes >> 20);
    if (slot.fault.empty()) return;
    slot.killAt = Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(2));
    slot.process->signal(SIGTERM);
    slot.process->signal(SIGCONT); // one that is stopped would not hear it
  }

  std::size_t residentBytes(const Slot& slot) {
    if (m_options.memoryBytes == 0) return 0;
    return slot.process->residentBytes();
  }

  void bury(Slot& slot, const base::ProcessEnd& end) {
    const std::optional<std::size_t> unit = slot.unit;
    const auto isCode = [&](base::ExitCode code) { return end.signal == 0 && end.exitCode == static_cast<int>(code); };
    const std::string words = describe(slot, end);
    const bool wasReady = slot.isReady, isAlone = slot.isAlone, wasToldToEnd = slot.fault.empty() && isBySignal(end);
    const std::string lastLine = slot.lastLines.empty() ? words : slot.lastLines.back();
    slot = {};
    if (isCode(base::ExitCode::otherPlan) || isCode(base::ExitCode::incomplete)) {
      m_result.otherPlan |= isCode(base::ExitCode::otherPlan);
      stopAll(lastLine);
    } else if (!wasReady) {
      if (++m_failedStarts < kMostStarts) return;
      m_isDead = true;
      stopAll("no worker can start: " + lastLine);
    } else if (unit && wasToldToEnd) { // as a scheduler tells all processes of a job: nothing is wrong with the scene
      (isAlone ? m_again : m_queue).push_front(*unit);
    } else if (unit) {
      fail(*unit, words, isAlone);
    } else if (end.signal != 0 || end.exitCode != 0) {
      base::logDetail("a worker ended badly after its work was done: " + words);
    }
  }

  // The exit code of a worker that was told to end and did.
  static bool isBySignal(const base::ProcessEnd& end) {
    constexpr int kOfSignals = 128;
    return end.signal == 0 && (end.exitCode == kOfSignals + SIGTERM || end.exitCode == kOfSignals + SIGINT);
  }

  std::string describe(const Slot& slot, const base::ProcessEnd& end) const {
    std::string words = !slot.fault.empty() ? slot.fault
                        : end.signal != 0   ? "crashed with " + base::signalName(end.signal)
                                            : fmt::format("ended with exit code {}", end.exitCode);
    if (const std::string stage = slot.page->get(); !stage.empty())
      words += fmt::format(" at '{}'", base::shownText(stage));
    if (!slot.lastLines.empty()) words += fmt::format("; its last lines: {}", fmt::join(slot.lastLines, " | "));
    return words;
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
      ++m_result.done;
      ++m_result.crashed;
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
    m_result.why = std::move(why);
  }

  void endAll() {
    for (const Slot& slot : m_slots)
      if (slot.process) slot.process->closeInput(), slot.process->signal(SIGTERM);
    const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(kGraceS));
    while (Clock::now() < deadline &&
           std::ranges::any_of(m_slots, [](const Slot& slot) { return slot.process && !slot.process->end(); })) {
      for (Slot& slot : m_slots)
        if (slot.process) listen(slot);
      wait();
    }
    m_slots.clear(); // kills what still runs
  }

  // Until a worker says something, and not long.
  void wait() const {
    std::vector<pollfd> descriptors;
    for (const Slot& slot : m_slots)
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
  std::deque<std::size_t> m_queue, m_again; // not begun; to be tried once more, alone
  std::size_t m_total;
  std::vector<Slot> m_slots;
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
