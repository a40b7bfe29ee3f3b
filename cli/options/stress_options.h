// The options of parity stress.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawStressOptions {
  StressCommand stress;
  std::string only;
  bool noValidation = false;
};

// `raw` must outlive the parsing.
void addStressOptions(CLI::App& app, RawStressOptions& raw);

// After parsing: the command that was given.
StressCommand settleStress(const RawStressOptions& raw);

} // namespace parity::cli
