// Long lines for a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace parity::base {

// The text in lines of at most `columns` (>= indent + 10), broken at spaces, or within a word that is longer than a
// line. The first has `used` columns taken already; the others begin with `indent` spaces. columns 0: as it is.
// text: clean UTF-8 without controls and colours.
std::string wrapText(std::string_view text, std::size_t columns, std::size_t used, std::size_t indent);

// A command of a POSIX shell, broken at spaces outside of quotes, where " \\" ends a line: it may be copied as it is.
// A word that is longer than a line stays whole. columns, indent: as above; the first line is indented, too.
std::string wrapCommand(std::string_view command, std::size_t columns, std::size_t indent);

} // namespace parity::base
