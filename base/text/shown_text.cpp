#include "base/text/shown_text.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "base/text/code_ranges.h"
#include "base/text/utf8.h"

namespace parity::base {
namespace {

// Marks, embeddings, overrides and isolates of the bidirectional algorithm; line and paragraph separators.
constexpr std::array kReordering = {CodeRange{0x061C, 0x061C}, CodeRange{0x200E, 0x200F}, CodeRange{0x2028, 0x202E},
                                    CodeRange{0x2066, 0x2069}};
// What a log's reader may skip in front of a command (White_Space of Unicode, without what is replaced anyway).
constexpr std::array kSpaces = {CodeRange{'\t', '\t'},     CodeRange{' ', ' '},       CodeRange{0x00A0, 0x00A0},
                                CodeRange{0x1680, 0x1680}, CodeRange{0x2000, 0x200A}, CodeRange{0x202F, 0x202F},
                                CodeRange{0x205F, 0x205F}, CodeRange{0x3000, 0x3000}};
// = + - @ and their full-width forms.
constexpr std::array kFormula = {CodeRange{'=', '='},       CodeRange{'+', '+'},       CodeRange{'-', '-'},
                                 CodeRange{'@', '@'},       CodeRange{0xFF1D, 0xFF1D}, CodeRange{0xFF0B, 0xFF0B},
                                 CodeRange{0xFF0D, 0xFF0D}, CodeRange{0xFF20, 0xFF20}};

constexpr std::array<std::string_view, 2> kCommandMarks = {"##[", "##vso["};

bool isUnfit(std::uint32_t code) { return code < 0x20 || (code >= 0x7F && code < 0xA0) || contains(kReordering, code); }

// Puts `instead` in the place of the second # of each command mark.
std::string withoutMarks(std::string text, std::string_view instead) {
  for (std::size_t at = text.find("##"); at != std::string::npos; at = text.find("##", at + 1))
    if (std::ranges::any_of(kCommandMarks,
                            [&](std::string_view mark) { return text.compare(at, mark.size(), mark) == 0; }))
      text.replace(at + 1, 1, instead);
  return text;
}

constexpr std::string_view kReplacementText = "\xEF\xBF\xBD";

// The length of "ESC [ digits and semicolons m" at the start of the text; 0: there is none.
std::size_t colorLength(std::string_view text) {
  if (!text.starts_with("\x1b[")) return 0;
  const std::size_t end = text.find_first_not_of("0123456789;", 2);
  return end != std::string_view::npos && text[end] == 'm' ? end + 1 : 0;
}

std::string shownLine(std::string_view line, Colors colors) {
  std::string out;
  for (std::size_t at = 0; at < line.size();) {
    if (const std::size_t color = colors == Colors::ours ? colorLength(line.substr(at)) : 0; color > 0) {
      out += line.substr(at, color);
      at += color;
    } else if (line[at] == '\t') {
      out += line[at++];
    } else {
      const std::size_t end = std::min(line.find_first_of("\t\x1b", at + 1), line.size());
      out += plainLine(line.substr(at, end - at));
      at = end;
    }
  }
  std::size_t begin = 0; // of what is no space
  bool atStart = true;
  forEachCode(out, [&](std::uint32_t code) {
    atStart = atStart && contains(kSpaces, code);
    if (!atStart) return;
    std::string space;
    appendUtf8(space, code);
    begin += space.size();
  });
  if (out.compare(begin, 2, "::") == 0) out.replace(begin + 1, 1, kReplacementText);
  return withoutMarks(std::move(out), kReplacementText); // a mark across two parts
}

bool isNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

} // namespace

std::string plainLine(std::string_view text) {
  std::string out;
  forEachCode(text, [&](std::uint32_t code) { appendUtf8(out, isUnfit(code) ? kReplacement : code); });
  return withoutMarks(std::move(out), kReplacementText);
}

std::string shownText(std::string_view text, Colors colors) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const bool isCrlf = end < text.size() && end > at && text[end - 1] == '\r';
    out += shownLine(text.substr(at, end - at - (isCrlf ? 1 : 0)), colors);
    if (end < text.size()) out += isCrlf ? "\r\n" : "\n";
    at = end + 1;
  }
  return out;
}

std::string shownStrings(std::string_view text) {
  std::string out;
  forEachCode(text, [&](std::uint32_t code) {
    if (code != '\n' && code != '\t' && isUnfit(code))
      out += fmt::format("\\u{:04x}", code); // none is above U+FFFF
    else
      appendUtf8(out, code);
  });
  return withoutMarks(std::move(out), "\\u0023");
}

std::string csvCell(std::string_view text) {
  std::string cell = plainLine(text);
  bool isFirst = true, isFormula = false;
  forEachCode(cell, [&](std::uint32_t code) {
    if (isFirst && code != ' ') isFormula = contains(kFormula, code), isFirst = false;
  });
  if (isFormula && !isNumber(cell)) cell.insert(0, 1, '\'');
  // A colon in front, too: quoted, a line that is printed starts with no workflow command.
  if (cell.find_first_of(",\"") == std::string::npos && !cell.starts_with(':')) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

} // namespace parity::base
