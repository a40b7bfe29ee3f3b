// Messages to stderr: progress, warnings, errors. stdout belongs to results.
#pragma once

#include <string>

namespace parity::base {

enum class LogLevel { quiet, normal, verbose };
void setLogLevel(LogLevel level);
LogLevel logLevel();

void logVerbose(const std::string& message); // only with -v
void logInfo(const std::string& message);    // not with -q
void logWarning(const std::string& message); // "warning: ..."; not with -q
void logError(const std::string& message);   // "error: ..."; always

} // namespace parity::base
