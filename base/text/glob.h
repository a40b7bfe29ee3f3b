// Shell-style patterns over names: materials, scenes, views.
#pragma once

#include <string>
#include <string_view>

namespace parity::base {

// Whether the whole of `text` matches `glob`: '*' any run of characters (also none), '?' one character, [abc] [a-z]
// [!abc] one character of (not of) a set; ']' is a member where it stands first, '-' where it stands first or last; a
// '[' that nothing closes stands for itself; there is no escape ("[*]" is a star). Case-sensitive. A character is a
// UTF-8 code point; a byte that belongs to none is a character of its own. At most |glob| x |text| steps.
bool matchesGlob(std::string_view glob, std::string_view text);

// A glob that matches this name alone; where a report could not show a byte of it (U+FFFD), any character.
std::string exactGlob(std::string_view name);

} // namespace parity::base
