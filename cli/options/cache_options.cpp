// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/cache_options.h"

#include <CLI/CLI.hpp>

#include "base/file.h"

namespace parity::cli {

void addCacheOptions(CLI::App& app, RawCacheOptions& raw) {
  app.require_subcommand(1);
  for (CLI::App* each : {app.add_subcommand("info", "Say what the cache holds, kind by kind, and where it lies"),
                         app.add_subcommand("clear", "Remove all of its entries, and nothing else")}) {
    each->add_option("--cache", raw.folder, "Cache folder. Default: $XDG_CACHE_HOME/parity");
    each->add_option("--json", raw.json, "Write what it held as JSON there; - for stdout");
  }
}

CacheCommand settleCache(const CLI::App& app, const RawCacheOptions& raw) {
  return {.clear = app.get_subcommand("clear")->parsed(),
          .folder = raw.folder.empty() ? base::defaultCacheFolder() : std::filesystem::path(raw.folder),
          .json = raw.json};
}

} // namespace parity::cli
