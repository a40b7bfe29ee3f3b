#include "base/interrupt.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <deque>
#include <mutex>

#include "base/terminal.h"
#include "base/text/shown_text.h"

namespace parity::base {

namespace {

// Of the process, as signals are.
std::atomic<const std::string*> current = nullptr, stopNote = nullptr;
std::atomic<int> stopNumber = 0;

constexpr std::array kStopSignals = {SIGINT, SIGTERM, SIGHUP};
std::array<std::atomic<bool>, kStopSignals.size()> isTaken{};    // not ignored
std::array<void (*)(int), kStopSignals.size()> handlersBefore{}; // there was a StopSignal
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
                  std::atomic<const std::string*>::is_always_lock_free,
              "a handler may use them");

// The handlers do nothing but what is safe in one.
void tell(const std::string* text) {
  if (!text) return;
  const ssize_t written = ::write(STDERR_FILENO, text->data(), text->size());
  static_cast<void>(written); // there is nobody left to tell
}

void tellAndEnd(int number) {
  tell(current.load());
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void rememberOnce(int number) {
  for (std::size_t i = 0; i < kStopSignals.size(); ++i)
    if (isTaken[i]) std::signal(kStopSignals[i], SIG_DFL);
  int none = 0;
  if (stopNumber.compare_exchange_strong(none, number)) tell(stopNote.load());
}

void listen() {
  for (const int number : {SIGINT, SIGTERM})
    if (std::signal(number, tellAndEnd) == SIG_IGN) std::signal(number, SIG_IGN);
}

// For good, as a handler may be reading it.
const std::string* keep(const std::string& line) {
  static std::mutex mutex;
  static std::deque<std::string> texts;
  const std::lock_guard lock(mutex);
  const std::string wipe = wipeLine(readTerminal(STDERR_FILENO)); // a progress bar
  return &texts.emplace_back(wipe + shownText(line) + "\n");
}

} // namespace

void setInterruptNote(const std::string& line) {
  current = keep("error: " + line);
  static const bool listens = (listen(), true);
  static_cast<void>(listens);
}

StopSignal::StopSignal(const std::string& note) {
  stopNote = note.empty() ? nullptr : keep(note);
  stopNumber = 0;
  for (std::size_t i = 0; i < kStopSignals.size(); ++i) {
    struct sigaction before {};
    sigaction(kStopSignals[i], nullptr, &before);
    handlersBefore[i] = before.sa_handler;
    isTaken[i] = before.sa_handler != SIG_IGN;
  }
  for (std::size_t i = 0; i < kStopSignals.size(); ++i)
    if (isTaken[i]) std::signal(kStopSignals[i], rememberOnce);
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < kStopSignals.size(); ++i) std::signal(kStopSignals[i], handlersBefore[i]);
}

int StopSignal::received() { return stopNumber; }

std::string signalName(int number) {
  const char* name = ::sigabbrev_np(number);
  return name ? std::string("SIG") + name : "signal " + std::to_string(number);
}

} // namespace parity::base
