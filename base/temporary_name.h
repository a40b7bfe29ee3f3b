// The names under which files are written before they get their own.
#pragma once

#include <optional>
#include <string>

namespace parity::base {

// ".stem.ID-N.ext" for "stem.ext", another one each time: hidden, unique to the process, of the same extension.
std::string temporaryNameOf(const std::string& fileName);

// The file's own name, where this is one that temporaryNameOf() gives: of a process that writes it, or was killed.
std::optional<std::string> ownNameOf(const std::string& temporaryName);

} // namespace parity::base
