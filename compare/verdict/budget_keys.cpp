#include "compare/verdict/budget_keys.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/image/image.h"
#include "base/text/nearest.h"

namespace parity::compare {

namespace {

// A line that a merge has left, and its number; 0: there is none.
std::pair<std::size_t, std::string> findConflictMarker(std::string_view text) {
  constexpr std::string_view kMarkers[] = {"<<<<<<<", "|||||||", "=======", ">>>>>>>"};
  std::size_t number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    if (line.ends_with('\r')) line.remove_suffix(1);
    for (const std::string_view marker : kMarkers)
      if (line.starts_with(marker) && (line.size() == marker.size() || line[marker.size()] == ' '))
        return {number, std::string(line)};
    at = end + 1;
  }
  return {0, {}};
}

} // namespace

toml::table BudgetKeys::parse(std::string_view text) const {
  try {
    return toml::parse(text, m_file);
  } catch (const toml::parse_error& error) {
    if (const auto [line, marker] = findConflictMarker(text); line > 0)
      throw base::fileError(m_file, fmt::format("line {}", line),
                            fmt::format("a merge conflict marker ('{}'): resolve the conflict", marker));
    refuse(error.source(), std::string(error.description()));
  }
}

void BudgetKeys::refuse(const toml::source_region& where, const std::string& reason) const {
  throw base::fileError(m_file, fmt::format("line {}", where.begin.line), reason);
}

void BudgetKeys::refuseUnknown(const toml::table& table, std::span<const std::string_view> known) const {
  for (const auto& [key, node] : table)
    if (std::ranges::find(known, key.str()) == known.end())
      refuse(key.source(), fmt::format("unknown key '{}'; {}", key.str(), base::describeNearest(key.str(), known)));
}

std::vector<const toml::table*> BudgetKeys::tablesOf(const toml::node& node, std::string_view key) const {
  const toml::array* array = node.as_array();
  if (!array) refuse(node.source(), fmt::format("'{0}' must be an array of tables: [[{0}]]", key));
  std::vector<const toml::table*> tables;
  for (const toml::node& element : *array) {
    if (!element.is_table()) refuse(element.source(), fmt::format("an entry of '{}' is not a table", key));
    tables.push_back(element.as_table());
  }
  return tables;
}

std::string BudgetKeys::textOf(const toml::table& table, std::string_view key, std::string fallback) const {
  const toml::node* node = table.get(key);
  if (!node) return fallback;
  const auto* text = node->as_string();
  if (!text) refuse(node->source(), fmt::format("'{}' must be a string", key));
  if (text->get().empty()) refuse(node->source(), fmt::format("'{}' is empty", key));
  return text->get();
}

std::uint64_t BudgetKeys::readPixels(const toml::node& node, const char* key, const char* hint) const {
  if (!node.is_integer()) refuse(node.source(), fmt::format("'{}' must be a whole number", key));
  const std::int64_t count = node.as_integer()->get();
  if (count < 1 || count > static_cast<std::int64_t>(base::kMaxImagePixels))
    refuse(node.source(),
           fmt::format("'{}' is {}, outside the range 1..{}{}", key, count, base::kMaxImagePixels, hint));
  return static_cast<std::uint64_t>(count);
}

} // namespace parity::compare
