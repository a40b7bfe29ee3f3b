// Untrusted text made fit to be shown: names of materials and scenes come from files that anyone may have written.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/text/shown_text.h"

namespace parity::base {

// Valid UTF-8: every byte that belongs to no code point (also of overlong forms and surrogates) becomes U+FFFD.
std::string cleanUtf8(std::string_view text);

// For text and quoted attributes of HTML and XML 1.0 alike: clean UTF-8, & < > " ' as references, line feed, tab and
// carriage return too (an XML attribute would turn them into spaces), and what XML forbids (other controls, U+FFFE,
// U+FFFF) as U+FFFD.
std::string escapeMarkup(std::string_view text);

// Columns that clean UTF-8 takes on a terminal: 2 for East Asian wide characters and emoji, 0 for combining marks.
std::size_t displayWidth(std::string_view text);

// Cut to at most `columns` (>= 1), the last of which is then "…"; padded on the right with spaces to exactly `columns`.
std::string fitColumns(std::string_view text, std::size_t columns);

} // namespace parity::base
