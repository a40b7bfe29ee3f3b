// Messages to stderr, each in one write, so that lines of different threads do not mix.
#include "base/log.h"

#include <atomic>
#include <cstdio>
#include <string_view>

#include <unistd.h>

#include "base/terminal.h"
#include "base/text/shown_text.h"

namespace parity::base {

namespace {

std::atomic<LogLevel> level = LogLevel::normal; // of the process, as stderr is

void writeLine(std::string_view prefix, const std::string& message) {
  // On a terminal a progress bar may stand on the line: wipe it first.
  static const std::string kWipe = wipeLine(readTerminal(STDERR_FILENO));
  std::string lines(kWipe);
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = message.find('\n', begin);
    lines += shownText(std::string(prefix) + message.substr(begin, end - begin)) + '\n';
  }
  std::fwrite(lines.data(), 1, lines.size(), stderr);
}

} // namespace

void setLogLevel(LogLevel newLevel) { level = newLevel; }
LogLevel logLevel() { return level; }

void logDetail(const std::string& message) {
  if (level == LogLevel::verbose) writeLine("", message);
}

void logInfo(const std::string& message) {
  if (level != LogLevel::quiet) writeLine("", message);
}

void logWarning(const std::string& message) {
  if (level != LogLevel::quiet) writeLine("warning: ", message);
}

void logRunWarnings(const std::vector<std::string>& messages) {
  std::string text;
  for (const std::string& message : messages)
    text += (text.empty() ? "" : level == LogLevel::quiet ? "; " : "\n") + message;
  if (!text.empty()) writeLine("warning: ", text);
}

void logError(const std::string& message) { writeLine("error: ", message); }

void logPlain(const std::string& message) { writeLine("", message); }

} // namespace parity::base
