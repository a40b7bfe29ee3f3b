// The options of parity worst.
#pragma once

#include "cli/invocation.h"
#include "cli/options/common_options.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawWorstOptions {
  WorstCommand worst;
  RawOptions common;
};

// `raw` must outlive the parsing.
void addWorstOptions(CLI::App& app, RawWorstOptions& raw);
// After parsing. Throws CLI::ParseError for what cannot be meant.
WorstCommand settleWorst(const CLI::App& app, const RawWorstOptions& raw);

} // namespace parity::cli
