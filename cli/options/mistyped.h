// What a command line that CLI11 refuses is told: the name that was probably meant.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace parity::cli {

// The innermost subcommand that was given.
const CLI::App& chosenOf(const CLI::App& app);

// After a parse that failed: about a subcommand or an option that does not exist; empty where all are known. It goes
// before what CLI11 says, which may be that something else is missing, as the value of an unknown option is taken for a
// scene.
std::string describeMistyped(const CLI::App& app);

// As "parity budget suggest".
std::string fullName(const CLI::App& app);

} // namespace parity::cli
