// The options of parity export that no other subcommand has. Only for the files that know CLI11.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/invocation.h"

namespace parity::cli {

// `command` must outlive the parsing.
void addExportOptions(CLI::App& app, ExportCommand& command);

} // namespace parity::cli
