// Words of a command that people copy.
#pragma once

#include <string>
#include <string_view>

namespace parity::base {

// A word as a POSIX shell takes it: quoted where it has to be.
std::string shellWord(std::string_view word);

} // namespace parity::base
