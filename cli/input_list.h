// Lists that are read from standard input, where "-" stands for them.
#pragma once

#include <string>
#include <vector>

namespace parity::cli {

// `values` with the lines of standard input in the place of "-": without white space around them, without those that
// are empty or begin with '#'. what: they name, in messages ("scene"). Throws Error (usage) for a second "-", and Error
// (failed) where standard input names none or is too large.
std::vector<std::string> withListed(const std::vector<std::string>& values, const std::string& what);

} // namespace parity::cli
