// The JSON Schema of report.json: a definition for each record that has a name.
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text/json_writer.h"
#include "report/record/generated.h"
#include "report/record/report_records.h"

namespace parity::report {
namespace {

std::string jsonText(std::string_view text) {
  base::JsonWriter writer(base::JsonLayout::compact);
  writer.text(text);
  std::string out = writer.finish();
  out.pop_back(); // the line feed
  return out;
}

std::string listOf(const std::vector<std::string>& texts) {
  std::vector<std::string> all;
  for (const std::string& text : texts) all.push_back(jsonText(text));
  return fmt::format("[{}]", fmt::join(all, ", "));
}

class SchemaWriter {
public:
  std::string write() {
    std::string out = "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n  \"title\": \"parity "
                      "report.json\",\n";
    out += objectBody(kRecord<Report>.words, "  ", kRecord<Report>.rows, Report());
    return out + fmt::format(",\n  \"$defs\": {{\n{}\n  }}\n}}\n", fmt::join(m_definitions, ",\n"));
  }

private:
  // Members of the object that is the schema of a value.
  template <typename T> std::string schemaOf(const Rule& rule, std::string_view words) {
    const bool isNullable = ifEmpty<T>(rule) == IfEmpty::null;
    const std::string description = words.empty() ? "" : fmt::format(", \"description\": {}", jsonText(words));
    if constexpr (kIsOptional<T>) {
      return schemaOf<typename T::value_type>(rule, words);
    } else if constexpr (std::is_same_v<T, Schema>) {
      return fmt::format("\"const\": {}{}", T::value, description);
    } else if constexpr (std::is_same_v<T, bool>) {
      return "\"type\": \"boolean\"" + description;
    } else if constexpr (std::is_arithmetic_v<T>) {
      const double least = std::is_unsigned_v<T> ? std::max(rule.least, 0.0) : rule.least;
      const char* type = std::is_integral_v<T> ? "\"integer\"" : rule.finite ? "\"number\"" : R"(["number", "null"])";
      return fmt::format("\"type\": {}{}{}{}", type, description,
                         std::isfinite(least) ? fmt::format(", \"minimum\": {}", least) : "",
                         std::isfinite(rule.most) ? fmt::format(", \"maximum\": {}", rule.most) : "");
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (!rule.oneOf.empty()) return fmt::format("\"enum\": {}{}", listOf(splitNames(rule.oneOf)), description);
      return fmt::format("\"type\": {}{}{}", isNullable ? R"(["string", "null"])" : "\"string\"", description,
                         rule.filled ? ", \"minLength\": 1" : "");
    } else if constexpr (kIsMap<T>) {
      return fmt::format("\"type\": \"object\"{}, \"additionalProperties\": {{{}}}", description,
                         schemaOf<typename T::mapped_type>(Rule(), ""));
    } else if constexpr (kIsList<T>) {
      using Element = typename T::value_type;
      if constexpr (IsByName<Element>)
        return fmt::format("\"type\": \"object\"{}, \"additionalProperties\": {{{}}}", description,
                           schemaOf<double>(Rule(), ""));
      else
        return fmt::format("\"type\": \"array\"{}, \"items\": {{{}}}", description,
                           schemaOf<Element>(Rule{.finite = rule.finite}, ""));
    } else {
      const std::string whole = named<T>(rule);
      return isNullable ? fmt::format("\"anyOf\": [{{\"type\": \"null\"}}, {{{}}}]{}", whole, description)
                        : whole + description;
    }
  }

  template <Named T> std::string named(const Rule& rule) {
    std::vector<std::string> names;
    for (const T value : Names<T>::values) names.push_back(Names<T>::nameOf(value));
    if (!rule.oneOf.empty() || Names<T>::name.empty())
      return "\"enum\": " + listOf(rule.oneOf.empty() ? names : splitNames(rule.oneOf));
    define(Names<T>::name, [&] {
      return fmt::format("      \"enum\": {},\n      \"description\": {}", listOf(names), jsonText(Names<T>::words));
    });
    return reference(Names<T>::name);
  }
  template <Described T> std::string named(const Rule&) {
    define(kRecord<T>.name, [this] { return objectBody(kRecord<T>.words, "      ", kRecord<T>.rows, T()); });
    return reference(kRecord<T>.name);
  }
  static std::string reference(std::string_view name) { return fmt::format("\"$ref\": \"#/$defs/{}\"", name); }

  template <typename Body> void define(std::string_view name, const Body& body) {
    if (!m_names.insert(std::string(name)).second) return;
    const std::size_t place = m_definitions.size();
    m_definitions.emplace_back(); // before those that it needs itself
    std::string text = fmt::format("    \"{}\": {{\n{}\n    }}", name, body());
    m_definitions[place] = std::move(text);
  }

  // owner: names the type that the rows are of.
  template <typename Owner, typename... Rows> std::string
  objectBody(std::string_view words, const std::string& indent, const std::tuple<Rows...>& rows, const Owner& owner) {
    std::vector<std::string> required, properties;
    forEachRow(rows, [&](const auto& row) { addProperty(row, indent + "  ", owner, required, properties); });
    std::string out = indent + "\"type\": \"object\",\n";
    if (!words.empty()) out += fmt::format("{}\"description\": {},\n", indent, jsonText(words));
    return out + fmt::format("{0}\"additionalProperties\": false,\n{0}\"required\": {1},\n{0}\"properties\": {{\n{2}\n"
                             "{0}}}",
                             indent, listOf(required), fmt::join(properties, ",\n"));
  }
  template <typename Member, typename Show, typename Owner>
  void addProperty(const Row<Member, Show>& row, const std::string& indent, const Owner&,
                   std::vector<std::string>& required, std::vector<std::string>& properties) {
    if constexpr (kIsShown<Show>) {
      using Value = ShownType<Owner, Show>;
      if (ifEmpty<Value>(row.rule) != IfEmpty::absent) required.emplace_back(row.key);
      properties.push_back(fmt::format("{}\"{}\": {{{}}}", indent, row.key, schemaOf<Value>(row.rule, row.words)));
    }
  }
  template <typename IsNull, typename... Rows, typename Owner>
  void addProperty(const Group<IsNull, Rows...>& group, const std::string& indent, const Owner& owner,
                   std::vector<std::string>& required, std::vector<std::string>& properties) {
    constexpr bool kIsNullable = !std::is_null_pointer_v<IsNull>;
    required.emplace_back(group.key);
    properties.push_back(
        kIsNullable ? fmt::format("{0}\"{1}\": {{\n{0}  \"anyOf\": [{{\"type\": \"null\"}}, {{\n{2}\n{0}  }}]\n{0}}}",
                                  indent, group.key, objectBody(group.words, indent + "    ", group.rows, owner))
                    : fmt::format("{0}\"{1}\": {{\n{2}\n{0}}}", indent, group.key,
                                  objectBody(group.words, indent + "  ", group.rows, owner)));
  }

  std::set<std::string> m_names;
  std::vector<std::string> m_definitions;
};

} // namespace

std::string reportSchema() { return SchemaWriter().write(); }

} // namespace parity::report
