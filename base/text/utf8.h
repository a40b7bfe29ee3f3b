// UTF-8 decoded by hand once, here; everything else walks over its code points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace parity::base {

inline constexpr std::uint32_t kReplacement = 0xFFFD;

// Appends a code point, at most U+10FFFF.
inline void appendUtf8(std::string& out, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6);
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 0x3F));
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

// Calls visit(code point) for each; for U+FFFD where there is none, one for each wrong byte (also of overlong forms and
// surrogates).
template <typename Visit> void forEachCode(std::string_view text, Visit visit) {
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t first = static_cast<unsigned char>(text[at]);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    std::uint32_t code = length <= 1 ? first : first & (0xFFu >> (length + 1));
    bool valid = length > 0 && at + length <= text.size();
    for (std::size_t i = 1; valid && i < length; ++i) {
      const std::uint32_t next = static_cast<unsigned char>(text[at + i]);
      valid = (next & 0xC0) == 0x80;
      code = code << 6 | (next & 0x3F);
    }
    const std::uint32_t least = length == 4 ? 0x10000 : length == 3 ? 0x800 : 0; // less is an overlong form
    valid = valid && code >= least && code <= 0x10FFFF && !(code >= 0xD800 && code < 0xE000);
    visit(valid ? code : kReplacement);
    at += valid ? length : 1;
  }
}

} // namespace parity::base
