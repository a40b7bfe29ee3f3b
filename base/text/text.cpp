#include "base/text/text.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/text/code_ranges.h"
#include "base/text/utf8.h"

namespace parity::base {
namespace {

// Unicode Standard Annex 11, East_Asian_Width W and F, and emoji shown as such: the blocks, not each code point.
constexpr std::array kWide = {CodeRange{0x1100, 0x115F},   CodeRange{0x231A, 0x231B},   CodeRange{0x2E80, 0x303E},
                              CodeRange{0x3041, 0xA4CF},   CodeRange{0xA960, 0xA97F},   CodeRange{0xAC00, 0xD7A3},
                              CodeRange{0xF900, 0xFAFF},   CodeRange{0xFE30, 0xFE6F},   CodeRange{0xFF00, 0xFF60},
                              CodeRange{0xFFE0, 0xFFE6},   CodeRange{0x1F300, 0x1F64F}, CodeRange{0x1F680, 0x1F6FF},
                              CodeRange{0x1F900, 0x1F9FF}, CodeRange{0x20000, 0x3FFFD}};
// General categories Mn and Me of the common scripts, joiners and variation selectors.
constexpr std::array kNoWidth = {CodeRange{0x0300, 0x036F}, CodeRange{0x0483, 0x0489}, CodeRange{0x0591, 0x05BD},
                                 CodeRange{0x064B, 0x065F}, CodeRange{0x1AB0, 0x1AFF}, CodeRange{0x1DC0, 0x1DFF},
                                 CodeRange{0x200B, 0x200D}, CodeRange{0x20D0, 0x20FF}, CodeRange{0xFE00, 0xFE0F},
                                 CodeRange{0xFE20, 0xFE2F}, CodeRange{0xFEFF, 0xFEFF}};
std::size_t widthOf(std::uint32_t code) { return contains(kNoWidth, code) ? 0 : contains(kWide, code) ? 2 : 1; }

} // namespace

std::string cleanUtf8(std::string_view text) {
  std::string out;
  forEachCode(text, [&](std::uint32_t code) { appendUtf8(out, code); });
  return out;
}

std::string escapeMarkup(std::string_view text) {
  std::string out;
  forEachCode(text, [&](std::uint32_t code) {
    switch (code) {
    case '&':
      out += "&amp;";
      return;
    case '<':
      out += "&lt;";
      return;
    case '>':
      out += "&gt;";
      return;
    case '"':
      out += "&quot;";
      return;
    case '\'':
      out += "&#39;";
      return;
    case '\n':
      out += "&#10;";
      return;
    case '\t':
      out += "&#9;";
      return;
    case '\r':
      out += "&#13;";
      return;
    default:
      appendUtf8(out, code < 0x20 || code == 0xFFFE || code == 0xFFFF ? kReplacement : code);
    }
  });
  return out;
}

std::size_t displayWidth(std::string_view text) {
  std::size_t columns = 0;
  forEachCode(text, [&](std::uint32_t code) { columns += widthOf(code); });
  return columns;
}

std::string fitColumns(std::string_view text, std::size_t columns) {
  const bool cut = displayWidth(text) > columns;
  const std::size_t room = cut ? columns - 1 : columns;
  std::string out;
  std::size_t used = 0;
  bool full = false;
  forEachCode(text, [&](std::uint32_t code) {
    full = full || used + widthOf(code) > room;
    if (full) return;
    appendUtf8(out, code);
    used += widthOf(code);
  });
  if (cut) {
    out += "…";
    ++used;
  }
  return out.append(columns - used, ' ');
}

} // namespace parity::base
