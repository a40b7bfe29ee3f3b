// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/cache_options.h"

#include <CLI/CLI.hpp>

#include "base/file.h"
#include "cli/options/option_parts.h"

namespace parity::cli {

void addCacheOptions(CLI::App& app, RawCacheOptions& raw) {
  app.require_subcommand(1);
  for (CLI::App* each : {app.add_subcommand("info", "Show the cache's folder, and what it holds of each kind"),
                         app.add_subcommand("clear", "Remove all entries of the cache, and nothing else")}) {
    each->add_option("--cache", raw.folder, "Cache folder. Default: $XDG_CACHE_HOME/parity")
        ->type_name(kFolder)
        ->group(kCacheGroup);
    each->add_option("--json", raw.json, "Write the contents as JSON to this file; - for stdout")
        ->type_name(kFile)
        ->group(kOutputGroup);
  }
}

CacheCommand settleCache(const CLI::App& app, const RawCacheOptions& raw) {
  return {.clear = app.get_subcommand("clear")->parsed(),
          .folder = raw.folder.empty() ? base::defaultCacheFolder() : std::filesystem::path(raw.folder),
          .json = raw.json};
}

} // namespace parity::cli
