#include "job/plan/worker_slot.h"

#include <algorithm>
#include <csignal>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/text/shown_text.h"
#include "job/plan/supervisor.h"

namespace parity::job {

namespace {

constexpr double kMostStartS = 120;                // until it is ready, where a scene may take less
constexpr double kLateS = 5;                       // for its end, after its work
constexpr std::chrono::seconds kTermTime{2};       // from SIGTERM to SIGKILL
constexpr double kMostDeathS = 10;                 // after SIGKILL: one that hangs in the kernel is given up
constexpr std::string_view kErrorMark = "error: "; // which its supervisor's message has, too
constexpr std::size_t kMostLines = 8, kMostLineBytes = 300;

} // namespace

void WorkerSlot::start(const SuperviseOptions& options, bool alone) {
  *this = {};
  page = std::make_unique<StagePage>();
  process = std::make_unique<base::ChildProcess>(options.command, page->descriptor());
  isAlone = alone;
  born = since = Clock::now();
}

void WorkerSlot::give(std::size_t given) {
  unit = given;
  ++scenes;
  m_lastLines.clear(); // they were of other scenes
  since = Clock::now();
  process->send(std::to_string(given));
}

void WorkerSlot::retire() {
  isRetiring = true;
  since = Clock::now();
  process->closeInput();
}

std::vector<std::string> WorkerSlot::listen(bool showErrors) {
  for (const std::string& line : process->readError()) {
    std::string shown = base::shownText(line).substr(0, kMostLineBytes);
    m_lastLines.push_back(shown.starts_with(kErrorMark) ? shown.substr(kErrorMark.size()) : std::move(shown));
    if (m_lastLines.size() > kMostLines) m_lastLines.pop_front();
    if (showErrors || base::logLevel() == base::LogLevel::verbose) base::logPlain(line);
  }
  return process->readOutput();
}

void WorkerSlot::kill() {
  process->signal(SIGKILL);
  if (!m_killedAt) m_killedAt = Clock::now();
}

void WorkerSlot::watch(const SuperviseOptions& options) {
  if (m_killAt) {
    if (Clock::now() >= *m_killAt) kill();
    return;
  }
  const double elapsed = secondsOf(since);
  if (isRetiring) { // a driver that hangs at its end has done its work
    if (elapsed > kLateS) kill();
    return;
  }
  const std::size_t bytes = options.memoryBytes > 0 ? process->residentBytes() : 0;
  if (elapsed > (isReady ? options.timeoutS : std::max(options.timeoutS, kMostStartS)))
    fault = fmt::format("took longer than {:g} s (--timeout)", options.timeoutS);
  else if (bytes > options.memoryBytes)
    fault = fmt::format("took more than {} MiB of memory (--memory)", options.memoryBytes >> 20);
  if (fault.empty()) return;
  m_killAt = Clock::now() + kTermTime;
  process->signal(SIGTERM);
  process->signal(SIGCONT); // one that is stopped would not hear it
}

std::optional<base::ProcessEnd> WorkerSlot::end() {
  if (const std::optional<base::ProcessEnd> ended = process->end()) return ended;
  if (m_killedAt && secondsOf(*m_killedAt) > kMostDeathS) return base::ProcessEnd{0, SIGKILL};
  return std::nullopt;
}

std::string WorkerSlot::describe(const base::ProcessEnd& end) const {
  std::string words = !fault.empty()    ? fault
                      : end.signal != 0 ? "crashed with " + base::signalName(end.signal)
                                        : fmt::format("ended with exit code {}", end.exitCode);
  if (const std::string stage = page->get(); !stage.empty()) words += fmt::format(" at '{}'", base::shownText(stage));
  if (!m_lastLines.empty()) words += fmt::format("; its last lines: {}", fmt::join(m_lastLines, " | "));
  return words;
}

bool WorkerSlot::wasToldToEnd(const base::ProcessEnd& end) const {
  constexpr int kOfSignals = 128;
  return fault.empty() && end.signal == 0 &&
         (end.exitCode == kOfSignals + SIGTERM || end.exitCode == kOfSignals + SIGINT ||
          end.exitCode == kOfSignals + SIGHUP);
}

} // namespace parity::job
