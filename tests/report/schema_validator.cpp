#include "report/schema_validator.h"

#include <algorithm>
#include <set>

namespace parity::report {
namespace {

using nlohmann::json;
using Findings = std::vector<std::string>;

bool hasType(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  return type == "integer" && value.is_number_integer();
}

class Validator {
public:
  explicit Validator(const json& root) : m_root(root) {}

  Findings check(const json& schema, const json& value, const std::string& path) const {
    Findings findings;
    const auto report = [&](const std::string& reason) { findings.push_back(path + ": " + reason); };
    const auto descend = [&](const json& part, const json& child, const std::string& name) {
      const Findings more = check(part, child, path + "/" + name);
      findings.insert(findings.end(), more.begin(), more.end());
    };
    for (const auto& [keyword, rule] : schema.items()) {
      if (keyword == "type") {
        const bool fits = rule.is_array() ? std::ranges::any_of(rule, [&](const json& t) { return hasType(value, t); })
                                          : hasType(value, rule);
        if (!fits) report("is not of type " + rule.dump());
      } else if (keyword == "properties") {
        if (value.is_object())
          for (const auto& [name, part] : rule.items())
            if (value.contains(name)) descend(part, value[name], name);
      } else if (keyword == "required") {
        for (const json& name : rule)
          if (value.is_object() && !value.contains(name.get<std::string>())) report("lacks " + name.dump());
      } else if (keyword == "additionalProperties") {
        if (value.is_object())
          for (const auto& [name, child] : value.items()) {
            if (schema.value("properties", json::object()).contains(name)) continue;
            if (rule == false)
              report("has an unknown key '" + name + "'");
            else
              descend(rule, child, name);
          }
      } else if (keyword == "items") {
        if (value.is_array())
          for (std::size_t i = 0; i < value.size(); ++i) descend(rule, value[i], std::to_string(i));
      } else if (keyword == "enum") {
        if (std::ranges::find(rule, value) == rule.end()) report(value.dump() + " is not one of " + rule.dump());
      } else if (keyword == "const") {
        if (value != rule) report("is not " + rule.dump());
      } else if (keyword == "minimum") {
        if (value.is_number() && value < rule) report("is less than " + rule.dump());
      } else if (keyword == "maximum") {
        if (value.is_number() && value > rule) report("is more than " + rule.dump());
      } else if (keyword == "minItems") {
        if (value.is_array() && value.size() < rule.get<std::size_t>()) report("has too few entries");
      } else if (keyword == "maxItems") {
        if (value.is_array() && value.size() > rule.get<std::size_t>()) report("has too many entries");
      } else if (keyword == "minLength") {
        if (value.is_string() && value.get<std::string>().size() < rule.get<std::size_t>()) report("is too short");
      } else if (keyword == "anyOf") {
        if (std::ranges::none_of(rule, [&](const json& part) { return check(part, value, path).empty(); }))
          report("fits none of anyOf");
      } else if (keyword == "$ref") {
        const std::string target = rule.get<std::string>();
        if (!target.starts_with("#/") || !m_root.contains(json::json_pointer(target.substr(1))))
          report("schema: no " + target);
        else
          for (const std::string& finding : check(m_root.at(json::json_pointer(target.substr(1))), value, path))
            findings.push_back(finding);
      } else if (!kAnnotations.contains(keyword)) {
        report("schema: keyword '" + keyword + "' is not known to this validator");
      }
    }
    return findings;
  }

private:
  inline static const std::set<std::string> kAnnotations = {"$schema", "$defs", "title", "description"};
  const json& m_root;
};

} // namespace

std::vector<std::string> validate(const json& schema, const json& document) {
  return Validator(schema).check(schema, document, "");
}

} // namespace parity::report
