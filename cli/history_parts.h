// What the subcommands of parity history share.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "cli/invocation.h"

namespace parity::cli {

int showHistory(const HistoryShowCommand& command);
int blameHistory(const HistoryBlameCommand& command);
int stepHistory(const HistoryStepCommand& command);

std::string describeEvents(const std::map<std::string, std::size_t>& events); // "2 regressed, 1 fixed"
std::string shownValue(double value);

} // namespace parity::cli
