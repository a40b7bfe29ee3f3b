// Messages to stderr: progress, warnings, errors. stdout belongs to results.
#pragma once

#include <string>
#include <vector>

namespace parity::base {

enum class LogLevel { quiet, normal, verbose };
void setLogLevel(LogLevel level);
LogLevel logLevel();

void logDetail(const std::string& message);  // with -v alone: what is done and with what, for who looks into a run
void logInfo(const std::string& message);    // not with -q
void logWarning(const std::string& message); // "warning: ..."; not with -q
// Of a whole run: a warning each; with -q all of them in one line.
void logRunWarnings(const std::vector<std::string>& messages);
void logError(const std::string& message); // "error: ..."; always
void logPlain(const std::string& message); // as it is; always

} // namespace parity::base
