// The options of parity explain.
#pragma once

#include "cli/invocation.h"
#include "cli/options/common_options.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in; its picture is smaller than a report's.
struct RawExplainOptions {
  ExplainCommand explain;
  RawOptions common;
};

// `raw` must outlive the parsing.
void addExplainOptions(CLI::App& app, RawExplainOptions& raw);
// After parsing. Throws CLI::ParseError for what cannot be meant.
ExplainCommand settleExplain(const CLI::App& app, const RawExplainOptions& raw);

} // namespace parity::cli
