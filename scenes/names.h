// Names from files, made fit for reports: one line, of bounded length, unique.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace parity::scenes {

// Before the name of a scene or an environment that is built in.
inline constexpr std::string_view kBuiltinPrefix = "builtin:";
bool isBuiltin(std::string_view fileOrBuiltin);
// "sky" of "builtin:sky", the stem of a file.
std::string stemOf(const std::string& fileOrBuiltin);

// Control characters become spaces, and what is not UTF-8 U+FFFD; what is longer than 128 bytes is cut between UTF-8
// characters and ends in "...".
std::string cleanName(std::string_view name);

// Hands out each name once: the second "a" becomes "a (2)".
class UniqueNames {
public:
  // `fallback` is taken where the cleaned name is empty.
  std::string make(std::string_view name, std::string_view fallback);

private:
  std::unordered_set<std::string> m_taken;
  std::unordered_map<std::string, int> m_last; // the last number given to a name
};

} // namespace parity::scenes
