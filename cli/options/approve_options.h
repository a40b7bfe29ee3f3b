// The options of parity approve.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawApprove {
  ApproveCommand command;
  std::string until, slack = "1%";
  std::vector<std::string> metrics;
};

// `raw` must outlive the parsing.
void addApproveOptions(CLI::App& app, RawApprove& raw);

// After parsing. Throws CLI::ParseError for what cannot be meant.
ApproveCommand settleApprove(const RawApprove& raw);

} // namespace parity::cli
