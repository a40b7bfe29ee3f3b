// The options of parity suite.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawSuiteOptions {
  SuiteListCommand list;
  std::string cacheFolder; // empty: the default one
};

// parity suite list. `raw` must outlive the parsing.
void addSuiteOptions(CLI::App& app, RawSuiteOptions& raw);
SuiteListCommand settleSuite(const RawSuiteOptions& raw);

} // namespace parity::cli
