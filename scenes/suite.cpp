// The suite file: TOML, every key known, every value checked. docs/suite.md describes it.
#include "scenes/suite.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/error.h"
#include "base/file.h"
#include "base/text/nearest.h"
#include "scenes/names.h"
#include "scenes/scene_settings.h"

namespace parity::scenes {
namespace {

constexpr std::size_t kMaxSuiteBytes = std::size_t{16} << 20;
constexpr std::string_view kBuiltin = "builtin:";

constexpr std::size_t kMaxCapturePlaces = 8;

// One table of the file: typed access with errors that name file, line and key.
class TableReader {
public:
  TableReader(const std::string& label, const toml::table& table, std::string_view what,
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

  base::Error errorAt(const toml::node& node, const std::string& key, const std::string& reason) const {
    return base::fileError(m_label, fmt::format("line {}: {}", node.source().begin.line, key), reason);
  }
  base::Error errorAt(std::string_view key, const std::string& reason) const {
    const toml::node* node = m_table.get(key);
    return errorAt(node ? *node : static_cast<const toml::node&>(m_table), std::string(key), reason);
  }

  std::optional<std::string> text(std::string_view key) const {
    const toml::node* node = m_table.get(key);
    if (!node) return std::nullopt;
    if (!node->is_string()) throw errorAt(key, "is not a string");
    std::string value = node->value_or(std::string{});
    if (value.empty()) throw errorAt(key, "is an empty string");
    return value;
  }

  // The value of a knob as the command line would have it; nothing where it is absent.
  std::optional<base::KnobValue> value(const std::string& key, const base::Knob& knob) const {
    const toml::node* node = m_table.get(key);
    if (!node) return std::nullopt;
    if (knob.type == base::KnobType::numbers || knob.type == base::KnobType::texts) return listOf(*node, key, knob);
    if (knob.type == base::KnobType::flag) {
      if (!node->is_boolean()) throw errorAt(key, "is not true or false");
      return base::KnobValue{node->value_or(false) ? "on" : "off"};
    }
    const bool isNumber = knob.type == base::KnobType::number || knob.type == base::KnobType::whole;
    if (isNumber && !node->is_number()) throw errorAt(key, "is not a number");
    if (isNumber || (knob.type == base::KnobType::choice && node->is_number()))
      return base::KnobValue{base::numberText(node->value_or(0.0))};
    return base::KnobValue{*text(key)};
  }

  // A list of [x, y, z]; empty where it is absent.
  std::vector<glm::vec3> points(std::string_view key, std::size_t most) const {
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

  bool has(std::string_view key) const { return m_table.contains(key); }
  bool isList(std::string_view key) const { return has(key) && m_table.get(key)->is_array(); }
  // As messages name it: "suite.toml: line 3: fov".
  std::string placeOf(std::string_view key) const {
    return fmt::format("{}: line {}: {}", m_label, m_table.get(key)->source().begin.line, key);
  }

  // [key]; null where it is absent. form: how it is written.
  const toml::table* table(std::string_view key, std::string_view form) const {
    const toml::node* node = m_table.get(key);
    if (node && !node->is_table()) throw errorAt(key, fmt::format("is not a table; write {}", form));
    return node ? node->as_table() : nullptr;
  }

  // An array of tables ([[key]]); empty where it is absent.
  std::vector<const toml::table*> tables(std::string_view key) const {
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

private:
  base::KnobValue listOf(const toml::node& node, const std::string& key, const base::Knob& knob) const {
    const bool ofTexts = knob.type == base::KnobType::texts;
    const auto count = static_cast<std::size_t>(std::count(knob.form.begin(), knob.form.end(), ',')) + 1;
    const std::string wanted = ofTexts ? "is not a list of strings" : fmt::format("is not a list of {} numbers", count);
    const toml::array* list = node.as_array();
    if (!list || (!ofTexts && list->size() != count)) throw errorAt(key, wanted);
    base::KnobValue values;
    for (const toml::node& entry : *list) {
      if (ofTexts ? !entry.is_string() : !entry.is_number()) throw errorAt(entry, key, wanted);
      values.push_back(ofTexts ? entry.value_or(std::string()) : base::numberText(entry.value_or(0.0)));
    }
    return ofTexts ? values : base::KnobValue{fmt::format("{}", fmt::join(values, ","))};
  }

  double numberOf(const toml::node& node, std::string_view key, double least, double most) const {
    if (!node.is_number()) throw errorAt(node, std::string(key), "is not a number");
    const double value = node.value_or(0.0);
    if (!(value >= least && value <= most)) // NaN too
      throw errorAt(node, std::string(key), fmt::format("{} is not from {} to {}", value, least, most));
    return value;
  }

  const std::string& m_label;
  const toml::table& m_table;
};

std::string resolve(const std::filesystem::path& folder, const std::string& file) {
  return file.starts_with(kBuiltin) ? file : (folder / file).lexically_normal().string();
}

std::string defaultName(const std::string& file) {
  if (file.starts_with(kBuiltin)) return file.substr(kBuiltin.size());
  return cleanName(std::filesystem::path(file).stem().string());
}

// The keys of these knobs, their older names too, after `others`.
std::vector<std::string> keysOf(const std::vector<base::Knob>& knobs, std::vector<std::string> others) {
  for (const base::Knob& knob : knobs) {
    others.push_back(base::keyOf(knob.id));
    for (const std::string& alias : knob.aliases) others.push_back(base::keyOf(alias));
  }
  return others;
}

// One file.
class SuiteReader {
public:
  SuiteReader(const std::filesystem::path& file, const SuiteKnobs& knobs)
      : m_label(file.string()), m_folder(file.parent_path()), m_knobs(knobs) {}

  // What a table says of these knobs.
  base::GivenKnobs readKnobs(const TableReader& reader, const std::vector<base::Knob>& knobs,
                             const std::function<void(const base::Knob&, const base::KnobValue&)>& check) const {
    base::GivenKnobs given;
    for (const base::Knob& knob : knobs) {
      std::vector<std::string> names = {knob.id};
      names.insert(names.end(), knob.aliases.begin(), knob.aliases.end());
      for (const std::string& name : names) {
        const std::string key = base::keyOf(name);
        std::optional<base::KnobValue> value = reader.value(key, knob);
        if (!value) continue;
        if (given.contains(knob.id))
          throw reader.errorAt(
              key, fmt::format("has the same meaning as '{}'; give only one of them", base::keyOf(knob.id)));
        if (knob.type == base::KnobType::file) value = base::KnobValue{resolve(m_folder, value->at(0))};
        add(given, reader, key, knob, *value, check);
      }
    }
    return given;
  }

  base::GivenKnobs readDefaults(const toml::table& table) const {
    const TableReader reader(m_label, table, "[defaults]", keysOf(m_knobs.knobs, {"fog"}));
    return readSceneKnobs(reader);
  }

  SuiteEntry readEntry(const toml::table& table) const {
    const TableReader reader(m_label, table, "a scene",
                             keysOf(m_knobs.knobs, {"name", "file", "captures", "budgets", "view", "fog"}));
    SuiteEntry entry;
    const auto file = reader.text("file");
    if (!file) throw reader.errorAt("file", "is missing; a scene needs a file or \"builtin:NAME\"");
    entry.scene = resolve(m_folder, *file);
    entry.name = cleanName(reader.text("name").value_or(defaultName(*file)));
    entry.given = readSceneKnobs(reader);
    entry.captures = reader.points("captures", kMaxCapturePlaces);
    if (const auto budgets = reader.text("budgets")) entry.budgets = resolve(m_folder, *budgets);
    std::set<std::string> names;
    for (const toml::table* view : reader.tables("view")) {
      entry.views.push_back(readView(*view, entry.views.size() + 1));
      if (!names.insert(entry.views.back().name).second)
        throw reader.errorAt(
            *view, "view",
            fmt::format("two views of scene '{1}' have the name '{0}'", entry.views.back().name, entry.name));
    }
    if (entry.views.empty()) entry.views.emplace_back();
    return entry;
  }

  Suite read(const toml::table& root) const {
    const TableReader reader(m_label, root, "a suite", {"name", "budgets", "defaults", "scene"});
    Suite suite;
    suite.name = cleanName(reader.text("name").value_or(std::filesystem::path(m_label).stem().string()));
    if (const auto budgets = reader.text("budgets")) suite.budgets = resolve(m_folder, *budgets);
    if (const toml::table* defaults = reader.table("defaults", "[defaults]")) suite.given = readDefaults(*defaults);
    std::set<std::string> names;
    for (const toml::table* table : reader.tables("scene")) {
      suite.entries.push_back(readEntry(*table));
      if (!names.insert(suite.entries.back().name).second)
        throw reader.errorAt(
            *table, "scene",
            fmt::format("two scenes have the name '{}'; give each its own name", suite.entries.back().name));
    }
    if (suite.entries.empty()) throw base::fileError(m_label, "", "has no scene; add [[scene]]");
    return suite;
  }

private:
  void add(base::GivenKnobs& given, const TableReader& reader, const std::string& key, const base::Knob& knob,
           const base::KnobValue& value,
           const std::function<void(const base::Knob&, const base::KnobValue&)>& check) const {
    try {
      check(knob, value);
    } catch (const base::KnobError& error) {
      throw reader.errorAt(key, error.reason);
    }
    given[knob.id] = {value, reader.placeOf(key)};
  }

  base::GivenKnobs readSceneKnobs(const TableReader& reader) const {
    if (!reader.has("fog") || reader.isList("fog")) return readKnobs(reader, m_knobs.knobs, m_knobs.check);
    // The table [fog]: each key is a knob of its own, but the first three, which are one.
    std::vector<base::Knob> others;
    std::copy_if(m_knobs.knobs.begin(), m_knobs.knobs.end(), std::back_inserter(others),
                 [](const base::Knob& knob) { return knob.id != "fog"; });
    base::GivenKnobs given = readKnobs(reader, others, m_knobs.check);
    const TableReader fog(m_label, *reader.table("fog", "[scene.fog]"), "a fog",
                          {"density", "height_falloff", "height", "color", "start_distance", "max_opacity"});
    if (!fog.has("density")) throw fog.errorAt("density", "is missing; it is the extinction in 1/m");
    const base::Knob number{.id = {}, .type = base::KnobType::number};
    std::string numbers;
    for (const char* key : {"density", "height_falloff", "height"})
      numbers += (numbers.empty() ? "" : ",") + fog.value(key, number).value_or(base::KnobValue{"0"}).at(0);
    for (const auto& [id, key] : {std::pair("fog", "density"), std::pair("fog-color", "color"),
                                  std::pair("fog-start", "start_distance"), std::pair("fog-opacity", "max_opacity")}) {
      // A lambda may not take a structured binding by reference in every compiler of C++20.
      const auto knob = std::find_if(m_knobs.knobs.begin(), m_knobs.knobs.end(),
                                     [id = id](const base::Knob& each) { return each.id == id; });
      if (knob == m_knobs.knobs.end() || !fog.has(key)) continue;
      add(given, fog, key, *knob, knob->id == "fog" ? base::KnobValue{numbers} : *fog.value(key, *knob), m_knobs.check);
    }
    return given;
  }

  ViewRequest readView(const toml::table& table, std::size_t number) const {
    std::vector<base::Knob> knobs;
    for (const auto& row : viewKnobs().rows()) knobs.push_back(row.knob);
    const TableReader reader(m_label, table, "a view", keysOf(knobs, {"name"}));
    ViewRequest view;
    const auto set = [&](const base::Knob& knob, const base::KnobValue& value) {
      viewKnobs().find(knob.id)->set(view, value);
    };
    readKnobs(reader, knobs, set);
    if (!view.camera.empty() && (view.orbit || view.target))
      throw reader.errorAt("camera", "cannot be combined with an orbit or a target");
    view.name = cleanName(reader.text("name").value_or(!view.camera.empty() ? view.camera
                                                       : view.orbit         ? fmt::format("view {}", number)
                                                                            : std::string("auto")));
    return view;
  }

  const std::string m_label;
  const std::filesystem::path m_folder;
  const SuiteKnobs& m_knobs;
};

} // namespace

Suite loadSuite(const std::filesystem::path& file, const SuiteKnobs& knobs) {
  const std::string label = file.string();
  std::string text;
  try {
    text = base::readText(file, kMaxSuiteBytes);
  } catch (const base::Error& error) {
    throw base::fileError(label, "", error.reason());
  }
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw base::fileError(label,
                          fmt::format("line {}, column {}", error.source().begin.line, error.source().begin.column),
                          std::string(error.description()));
  }
  return SuiteReader(file, knobs).read(root);
}

} // namespace parity::scenes
