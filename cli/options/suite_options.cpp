// By CLI11, as command_line.cpp, which it serves.
#include "cli/options/suite_options.h"

#include <CLI/CLI.hpp>

#include "base/file.h"
#include "cli/options/common_options.h"
#include "cli/options/option_parts.h"

namespace parity::cli {

void addSuiteOptions(CLI::App& app, RawSuiteOptions& raw) {
  app.require_subcommand(1);
  CLI::App& list = *app.add_subcommand("list", "Print the scenes of a suite, with views, tags and estimated times");
  list.add_option("suite", raw.list.suite, "Suite file (TOML)")->type_name(kFile)->required();
  addOnlyOption(list, raw.list.only);
  list.add_option("--cache", raw.cacheFolder,
                  "Cache folder with the times of earlier runs. Default: $XDG_CACHE_HOME/parity")
      ->type_name(kFolder)
      ->group(kCacheGroup);
  list.add_option("--json", raw.list.json, "Write the list as JSON to this file; - for stdout, instead of the text")
      ->type_name(kFile)
      ->group(kOutputGroup);
}

SuiteListCommand settleSuite(const RawSuiteOptions& raw) {
  SuiteListCommand command = raw.list;
  command.cacheFolder = raw.cacheFolder.empty() ? base::defaultCacheFolder() : std::filesystem::path(raw.cacheFolder);
  return command;
}

} // namespace parity::cli
