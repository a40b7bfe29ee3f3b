#include "base/text/markdown.h"

#include <fmt/format.h>

#include "base/text/shown_text.h"

namespace parity::base {
namespace {

constexpr std::string_view kZeroWidthSpace = "\xE2\x80\x8B";
constexpr std::string_view kPunctuation = "\\`*_{}[]<>#+!|~&\"'@^$";
// What begins a mention or a reference of either site, an emoji, or the rest of a link.
constexpr std::string_view kSigils = "@#!$~%&^*:";

} // namespace

std::string markdownText(std::string_view text) {
  const std::string line = plainLine(text);
  std::string out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (kPunctuation.find(c) != std::string_view::npos)
      out += fmt::format("&#{};", static_cast<int>(c));
    else
      out += c;
    const bool isBefore = i + 1 < line.size() && line[i + 1] != ' ';
    if (isBefore && kSigils.find(c) != std::string_view::npos) out += kZeroWidthSpace;
    // "www." is a link without a scheme.
    if (isBefore && c == '.' && i >= 3 && (line[i - 1] | 0x20) == 'w') out += kZeroWidthSpace;
  }
  return out;
}

std::string slackText(std::string_view text) {
  const std::string line = plainLine(text);
  std::string out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    switch (c) {
    case '&':
      out += "&amp;";
      break;
    case '<':
      out += "&lt;";
      break;
    case '>':
      out += "&gt;";
      break;
    case '*':
    case '_':
    case '~':
    case '`':
      out += kZeroWidthSpace;
      out += c;
      out += kZeroWidthSpace;
      break;
    case '@':
    case '#':
    case ':':
      out += c;
      if (i + 1 < line.size() && line[i + 1] != ' ') out += kZeroWidthSpace;
      break;
    default:
      out += c;
    }
  }
  return out;
}

} // namespace parity::base
