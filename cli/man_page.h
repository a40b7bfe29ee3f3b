// Manual pages in man(7) of roff, made of the same texts as --help.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/options/app_description.h"

namespace parity::cli {

// The page of the program ("" for parity.1) or of a command with all below it ("budget" for parity-budget.1).
std::string manPage(const CommandText& program, const std::string& command);

// All pages, each with the name of its file.
std::vector<std::pair<std::string, std::string>> manPages(const CommandText& program);

} // namespace parity::cli
