// Glob matching with one remembered star: only the last '*' ever needs to take more, so there is no recursion.
#include "base/text/glob.h"

#include <cstddef>
#include <cstdint>

namespace parity::base {
namespace {

struct Character {
  std::uint32_t code;
  std::size_t bytes;
};

// The character at `at` (< text.size()). Bytes that are not UTF-8 get codes above Unicode's, so they match themselves.
Character characterAt(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> std::uint32_t { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t first = byte(at);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 && first < 0xF8 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 0;
  const Character alone{0x110000 + first, 1};
  if (length == 0 || first >= 0xF8 || at + length > text.size()) return alone;
  std::uint32_t code = first & (0xFFu >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0) != 0x80) return alone;
    code = code << 6 | (byte(at + i) & 0x3F);
  }
  return {code, length};
}

struct Step {
  bool matches;
  std::size_t next; // where the glob goes on
};

// Matches one character against the set that opens at `open`; an unclosed set is a literal '['.
Step matchSet(std::string_view glob, std::size_t open, std::uint32_t code) {
  std::size_t at = open + 1;
  const bool inverted = at < glob.size() && glob[at] == '!';
  if (inverted) ++at;
  bool found = false;
  for (bool first = true; at < glob.size(); first = false) {
    if (glob[at] == ']' && !first) return {found != inverted, at + 1};
    const Character low = characterAt(glob, at);
    at += low.bytes;
    std::uint32_t high = low.code;
    if (at + 1 < glob.size() && glob[at] == '-' && glob[at + 1] != ']') {
      const Character upper = characterAt(glob, at + 1);
      high = upper.code;
      at += 1 + upper.bytes;
    }
    if (low.code <= code && code <= high) found = true;
  }
  return {code == '[', open + 1};
}

Step matchOne(std::string_view glob, std::size_t at, std::uint32_t code) {
  if (glob[at] == '?') return {true, at + 1};
  if (glob[at] == '[') return matchSet(glob, at, code);
  const Character literal = characterAt(glob, at);
  return {literal.code == code, at + literal.bytes};
}

} // namespace

bool matchesGlob(std::string_view glob, std::string_view text) {
  constexpr std::size_t kNone = std::string_view::npos;
  std::size_t g = 0, t = 0, afterStar = kNone, starText = 0;
  while (t < text.size()) {
    if (g < glob.size() && glob[g] == '*') {
      afterStar = ++g;
      starText = t;
      continue;
    }
    const Character character = characterAt(text, t);
    if (g < glob.size()) {
      const Step step = matchOne(glob, g, character.code);
      if (step.matches) {
        g = step.next;
        t += character.bytes;
        continue;
      }
    }
    if (afterStar == kNone) return false;
    starText += characterAt(text, starText).bytes; // the star takes one character more
    t = starText;
    g = afterStar;
  }
  while (g < glob.size() && glob[g] == '*') ++g;
  return g == glob.size();
}

std::string exactGlob(std::string_view name) {
  constexpr std::string_view kUnknown = "\xef\xbf\xbd";
  std::string glob;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (name.substr(i).starts_with(kUnknown)) {
      glob += '?';
      i += kUnknown.size() - 1;
    } else if (c == '*' || c == '?' || c == '[') {
      glob.append({'[', c, ']'});
    } else {
      glob += c;
    }
  }
  return glob;
}

} // namespace parity::base
