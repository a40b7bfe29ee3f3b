#include "base/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <deque>
#include <mutex>

#include "base/terminal.h"
#include "base/text/shown_text.h"

namespace parity::base {

namespace {

// Of the process, as signals are.
std::atomic<const std::string*> current = nullptr;

// Nothing but what is safe in a signal handler.
void tellAndEnd(int number) {
  if (const std::string* text = current.load()) {
    const ssize_t written = ::write(STDERR_FILENO, text->data(), text->size());
    static_cast<void>(written); // there is nobody left to tell
  }
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void listen() {
  for (const int number : {SIGINT, SIGTERM})
    if (std::signal(number, tellAndEnd) == SIG_IGN) std::signal(number, SIG_IGN);
}

} // namespace

void setInterruptNote(const std::string& line) {
  static std::mutex mutex;
  static std::deque<std::string> texts; // a handler may be reading any of them
  const std::lock_guard lock(mutex);
  static const bool listens = (listen(), true);
  static_cast<void>(listens);
  const std::string wipe = wipeLine(readTerminal(STDERR_FILENO)); // a progress bar
  current = &texts.emplace_back(wipe + shownText("error: " + line) + "\n");
}

} // namespace parity::base
