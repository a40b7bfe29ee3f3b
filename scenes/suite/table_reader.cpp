#include "scenes/suite/table_reader.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/nearest.h"
#include "scenes/names.h"

namespace parity::scenes {

TableReader::TableReader(const std::string& label, const toml::table& table, std::string_view what,
                         const std::vector<std::string>& keys)
    : m_label(label), m_table(table) {
  const std::vector<std::string_view> known(keys.begin(), keys.end());
  for (const auto& [key, node] : table) {
    const std::string_view name = key.str();
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw errorAt(node, cleanName(name),
                    fmt::format("unknown key in {}; {}", what, base::describeNearest(name, known)));
  }
}

base::Error TableReader::errorAt(const toml::node& node, const std::string& key, const std::string& reason) const {
  return base::fileError(m_label, fmt::format("line {}: {}", node.source().begin.line, key), reason);
}

base::Error TableReader::errorAt(std::string_view key, const std::string& reason) const {
  const toml::node* node = m_table.get(key);
  return errorAt(node ? *node : static_cast<const toml::node&>(m_table), std::string(key), reason);
}

std::string TableReader::placeOf(std::string_view key) const {
  return fmt::format("{}: line {}: {}", m_label, m_table.get(key)->source().begin.line, key);
}

std::string TableReader::place() const { return fmt::format("{}: line {}", m_label, m_table.source().begin.line); }

std::optional<std::string> TableReader::text(std::string_view key) const {
  const toml::node* node = m_table.get(key);
  if (!node) return std::nullopt;
  if (!node->is_string()) throw errorAt(key, "is not a string");
  std::string value = node->value_or(std::string{});
  if (value.empty()) throw errorAt(key, "is an empty string");
  return value;
}

std::vector<std::string> TableReader::texts(std::string_view key) const {
  const toml::node* node = m_table.get(key);
  if (!node) return {};
  const toml::array* list = node->as_array();
  if (!list || list->empty()) throw errorAt(key, "is not a list of strings, at least one");
  std::vector<std::string> values;
  for (const toml::node& entry : *list) {
    std::string value = entry.is_string() ? entry.value_or(std::string{}) : std::string{};
    if (value.empty()) throw errorAt(entry, std::string(key), "holds something that is not a string, or an empty one");
    values.push_back(std::move(value));
  }
  return values;
}

std::optional<base::KnobValue> TableReader::value(const std::string& key, const base::Knob& knob) const {
  const toml::node* node = m_table.get(key);
  if (!node) return std::nullopt;
  return valueOf(*node, key, knob);
}

std::vector<base::KnobValue> TableReader::values(const std::string& key, const base::Knob& knob) const {
  const toml::node* node = m_table.get(key);
  if (!node) return {};
  const toml::array* list = node->as_array();
  if (!list || list->empty()) throw errorAt(key, "is not a list of values, at least one");
  std::vector<base::KnobValue> all;
  for (const toml::node& entry : *list) {
    all.push_back(valueOf(entry, key, knob));
    if (std::count(all.begin(), all.end(), all.back()) > 1)
      throw errorAt(entry, key, fmt::format("'{}' is listed twice", fmt::join(all.back(), ", ")));
  }
  return all;
}

std::vector<glm::vec3> TableReader::points(std::string_view key, std::size_t most) const {
  const toml::node* node = m_table.get(key);
  if (!node) return {};
  const toml::array* list = node->as_array();
  if (!list || list->size() > most) throw errorAt(key, fmt::format("is not a list of at most {} places", most));
  std::vector<glm::vec3> values;
  for (const toml::node& entry : *list) {
    const toml::array* place = entry.as_array();
    if (!place || place->size() != 3) throw errorAt(entry, std::string(key), "is not a list of places [x, y, z]");
    glm::vec3& value = values.emplace_back();
    for (int c = 0; c < 3; ++c)
      value[c] = static_cast<float>(numberOf((*place)[static_cast<std::size_t>(c)], key, -1e6, 1e6));
  }
  return values;
}

const toml::table* TableReader::table(std::string_view key, std::string_view form) const {
  const toml::node* node = m_table.get(key);
  if (node && !node->is_table()) throw errorAt(key, fmt::format("is not a table; write {}", form));
  return node ? node->as_table() : nullptr;
}

std::vector<const toml::table*> TableReader::tables(std::string_view key) const {
  const toml::node* node = m_table.get(key);
  if (!node) return {};
  const toml::array* list = node->as_array();
  if (!list) throw errorAt(key, fmt::format("is not a list of tables; write [[{}]]", key));
  std::vector<const toml::table*> values;
  for (const toml::node& entry : *list) {
    if (!entry.is_table()) throw errorAt(entry, std::string(key), fmt::format("is not a table; write [[{}]]", key));
    values.push_back(entry.as_table());
  }
  return values;
}

base::KnobValue TableReader::valueOf(const toml::node& node, const std::string& key, const base::Knob& knob) const {
  if (knob.type == base::KnobType::numbers || knob.type == base::KnobType::texts) return listOf(node, key, knob);
  if (knob.type == base::KnobType::flag) {
    if (!node.is_boolean()) throw errorAt(node, key, "is not true or false");
    return {node.value_or(false) ? "on" : "off"};
  }
  const bool isNumber = knob.type == base::KnobType::number || knob.type == base::KnobType::whole;
  if (isNumber && !node.is_number()) throw errorAt(node, key, "is not a number");
  if (isNumber || (knob.type == base::KnobType::choice && node.is_number()))
    return {base::numberText(node.value_or(0.0))};
  if (!node.is_string()) throw errorAt(node, key, "is not a string");
  std::string value = node.value_or(std::string{});
  if (value.empty()) throw errorAt(node, key, "is an empty string");
  return {std::move(value)};
}

base::KnobValue TableReader::listOf(const toml::node& node, const std::string& key, const base::Knob& knob) const {
  const bool ofTexts = knob.type == base::KnobType::texts;
  const auto count = static_cast<std::size_t>(std::count(knob.form.begin(), knob.form.end(), ',')) + 1;
  const std::string wanted = ofTexts ? "is not a list of strings" : fmt::format("is not a list of {} numbers", count);
  const toml::array* list = node.as_array();
  if (!list || (!ofTexts && list->size() != count)) throw errorAt(node, key, wanted);
  base::KnobValue values;
  for (const toml::node& entry : *list) {
    if (ofTexts ? !entry.is_string() : !entry.is_number()) throw errorAt(entry, key, wanted);
    values.push_back(ofTexts ? entry.value_or(std::string()) : base::numberText(entry.value_or(0.0)));
  }
  return ofTexts ? values : base::KnobValue{fmt::format("{}", fmt::join(values, ","))};
}

double TableReader::numberOf(const toml::node& node, std::string_view key, double least, double most) const {
  if (!node.is_number()) throw errorAt(node, std::string(key), "is not a number");
  const double value = node.value_or(0.0);
  if (!(value >= least && value <= most)) // NaN too
    throw errorAt(node, std::string(key), fmt::format("{} is not from {} to {}", value, least, most));
  return value;
}

} // namespace parity::scenes
