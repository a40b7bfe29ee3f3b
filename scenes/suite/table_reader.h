// Typed access to a table of a TOML file. Every key is known; errors name file, line and key.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <toml++/toml.h>

#include "base/error.h"
#include "base/knob/knob.h"

namespace parity::scenes {

class TableReader {
public:
  // label: the file as the user named it; what: the table in words ("a scene"). All must outlive the reader. Throws
  // Error (exit 4), as every member does, for a key that is not known.
  TableReader(const std::string& label, const toml::table& table, std::string_view what,
              const std::vector<std::string>& keys);

  base::Error errorAt(const toml::node& node, const std::string& key, const std::string& reason) const;
  base::Error errorAt(std::string_view key, const std::string& reason) const;
  // As messages name it: "suite.toml: line 3: fov"; of the table itself: "suite.toml: line 2".
  std::string placeOf(std::string_view key) const;
  std::string place() const;

  bool has(std::string_view key) const { return m_table.contains(key); }
  bool isList(std::string_view key) const { return has(key) && m_table.get(key)->is_array(); }

  std::optional<std::string> text(std::string_view key) const;
  // A list of texts, none of them empty; nothing where it is absent.
  std::vector<std::string> texts(std::string_view key) const;
  // The value of a knob as the command line would have it; nothing where it is absent.
  std::optional<base::KnobValue> value(const std::string& key, const base::Knob& knob) const;
  // A list of values of a knob, as the command line would have each; nothing where it is absent.
  std::vector<base::KnobValue> values(const std::string& key, const base::Knob& knob) const;
  // A list of [x, y, z]; empty where it is absent.
  std::vector<glm::vec3> points(std::string_view key, std::size_t most) const;
  // [key]; null where it is absent. form: how it is written.
  const toml::table* table(std::string_view key, std::string_view form) const;
  // An array of tables ([[key]]); empty where it is absent.
  std::vector<const toml::table*> tables(std::string_view key) const;

private:
  base::KnobValue valueOf(const toml::node& node, const std::string& key, const base::Knob& knob) const;
  base::KnobValue listOf(const toml::node& node, const std::string& key, const base::Knob& knob) const;
  double numberOf(const toml::node& node, std::string_view key, double least, double most) const;

  const std::string& m_label;
  const toml::table& m_table;
};

} // namespace parity::scenes
