// The options of parity render that no other subcommand has. Only for the files that know CLI11.
#pragma once

#include <CLI/CLI.hpp>

#include "cli/invocation.h"

namespace parity::cli {

// Both must outlive the parsing. listTerms: set by --list-terms, which ends the parsing at once, as it needs no scene.
void addRenderOptions(CLI::App& app, RenderCommand& render, bool& listTerms);

} // namespace parity::cli
