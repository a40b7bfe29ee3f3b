// A text as a string of a TOML file.
#pragma once

#include <string>
#include <string_view>

namespace parity::base {

// In quotes, as clean UTF-8; quotes, backslashes and control characters are escaped.
std::string tomlString(std::string_view text);

} // namespace parity::base
