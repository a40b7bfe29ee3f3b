// The options of parity explain and parity worst.
#pragma once

#include "cli/invocation.h"
#include "cli/options/common_options.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in; the pictures are smaller than a report's.
struct RawExplainOptions {
  ExplainCommand explain;
  WorstCommand worst;
  RawOptions common;
};

// `raw` must outlive the parsing.
void addExplainOptions(CLI::App& app, RawExplainOptions& raw);
void addWorstOptions(CLI::App& app, RawExplainOptions& raw);
// After parsing. Throw CLI::ParseError for what cannot be meant.
ExplainCommand settleExplain(const CLI::App& app, const RawExplainOptions& raw);
WorstCommand settleWorst(const CLI::App& app, const RawExplainOptions& raw);

} // namespace parity::cli
