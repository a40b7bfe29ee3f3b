// The options of parity cache.
#pragma once

#include <string>

#include "cli/invocation.h"

namespace CLI {
class App;
}

namespace parity::cli {

// What CLI11 fills in.
struct RawCacheOptions {
  std::string folder, json; // empty folder: the default one
};

// parity cache info and clear. `raw` must outlive the parsing.
void addCacheOptions(CLI::App& app, RawCacheOptions& raw);

// After parsing: the subcommand that was given.
CacheCommand settleCache(const CLI::App& app, const RawCacheOptions& raw);

} // namespace parity::cli
