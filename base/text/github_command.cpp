#include "base/text/github_command.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/text/text.h"

namespace parity::base {
namespace {

// What the runner decodes again (actions/toolkit, command.ts: escapeData, escapeProperty): '%' and line ends, and in
// properties also what ends one. Other control characters and those that reorder text never get that far.
std::string escape(std::string_view text, bool property) {
  std::string out;
  const auto append = [&](std::string_view part) {
    for (const char c : plainLine(part)) {
      if (c == '%')
        out += "%25";
      else if (property && c == ':')
        out += "%3A";
      else if (property && c == ',')
        out += "%2C";
      else
        out += c;
    }
  };
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    append(text.substr(at, end - at));
    if (end < text.size()) out += text[end] == '\r' ? "%0D" : "%0A";
    at = end + 1;
  }
  return out;
}

// The place as GitHub names files: relative to the checkout, with '/'. Empty for one outside it.
std::string placeOf(const GithubCommand& command, const std::filesystem::path& root) {
  if (command.file.empty() || command.line == 0) return {};
  const std::filesystem::path file =
      (root / command.file).lexically_normal().lexically_relative(root.lexically_normal());
  if (file.empty() || *file.begin() == "..") return {};
  return fmt::format("file={},line={},", escape(file.generic_string(), true), command.line);
}

} // namespace

std::string toText(const GithubCommand& command, const std::filesystem::path& root) {
  return fmt::format("::{} {}title={}::{}\n", command.error ? "error" : "warning", placeOf(command, root),
                     escape(command.title, true), escape(command.message, false));
}

} // namespace parity::base
