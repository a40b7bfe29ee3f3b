// The walk over a glTF document that checks the type of every property we read.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenes/gltf/file/json.h"
#include "scenes/gltf/file/rules.h"
#include "scenes/names.h"

namespace parity::scenes {
namespace {

using Json = nlohmann::json;

// A value as a message shows it: short.
std::string show(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("an array of {}", value.size());
  return cleanName(value.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 40));
}

// The key as a JSON pointer has it (RFC 6901); whatever a file calls its attributes, a message stays one short line.
std::string escape(std::string_view key) {
  std::string out;
  for (const char c : cleanName(key)) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

class Checker {
public:
  Checker(const Json& document, Problems& problems) : m_document(document), m_problems(problems) {}

  void checkObject(Json& value, std::span<const Rule> rules, const std::string& place) {
    if (!value.is_object()) return fail(place, value, "an object");
    for (const Rule& rule : rules) {
      const auto found = value.find(rule.key);
      if (found != value.end())
        checkValue(*found, rule, fmt::format("{}/{}", place, rule.key));
      else if (rule.required)
        m_problems.add(fmt::format("{}/{}", place, rule.key), "is missing");
    }
  }

private:
  void fail(const std::string& place, const Json& value, const std::string& expected) {
    m_problems.add(place, fmt::format("is {}, expected {}", show(value), expected));
  }

  void checkValue(Json& value, const Rule& rule, const std::string& place) {
    switch (rule.kind) {
    case RuleKind::text:
      return checkText(value, rule, place);
    case RuleKind::boolean:
      if (!value.is_boolean()) fail(place, value, "true or false");
      return;
    case RuleKind::count:
      if (checkCount(value, place) && !rule.codes.empty() &&
          std::find(rule.codes.begin(), rule.codes.end(), value.get<int>()) == rule.codes.end())
        fail(place, value, fmt::format("one of {}", fmt::join(rule.codes, ", ")));
      return;
    case RuleKind::number:
      return checkNumber(value, place);
    case RuleKind::index:
      return checkIndex(value, rule.target, place);
    case RuleKind::object:
      return checkObject(value, rule.rules, place);
    case RuleKind::indexMap:
      return checkIndexMap(value, rule, place);
    case RuleKind::texts:
    case RuleKind::numbers:
    case RuleKind::indices:
    case RuleKind::indexMaps:
    case RuleKind::objects:
      return checkArray(value, rule, place);
    }
  }

  void checkText(const Json& value, const Rule& rule, const std::string& place) {
    if (!value.is_string()) return fail(place, value, "a string");
    if (!rule.choices.empty() &&
        std::find(rule.choices.begin(), rule.choices.end(), value.get_ref<const std::string&>()) == rule.choices.end())
      fail(place, value, fmt::format("one of {}", fmt::join(rule.choices, ", ")));
  }

  void checkIndexMap(Json& value, const Rule& rule, const std::string& place) {
    if (!value.is_object()) return fail(place, value, "an object");
    for (auto& [key, entry] : value.items()) checkIndex(entry, rule.target, fmt::format("{}/{}", place, escape(key)));
  }

  void checkArray(Json& value, const Rule& rule, const std::string& place) {
    if (!value.is_array()) return fail(place, value, "an array");
    if (rule.size && value.size() != rule.size)
      m_problems.add(place, fmt::format("holds {} numbers, expected {}", value.size(), rule.size));
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string at = fmt::format("{}/{}", place, i);
      switch (rule.kind) {
      case RuleKind::texts:
        checkText(value[i], rule, at);
        break;
      case RuleKind::numbers:
        checkNumber(value[i], at);
        break;
      case RuleKind::indices:
        checkIndex(value[i], rule.target, at);
        break;
      case RuleKind::indexMaps:
        checkIndexMap(value[i], rule, at);
        break;
      default:
        checkObject(value[i], rule.rules, at);
      }
    }
  }

  void checkNumber(Json& value, const std::string& place) {
    if (!value.is_number()) return fail(place, value, "a number");
    const double number = value.get<double>();
    if (!(std::abs(number) <= std::numeric_limits<float>::max()))
      return fail(place, value, "a number that 32 bits can hold");
    value = number; // the library behind us cuts whole numbers to 32 bits
  }

  bool checkCount(Json& value, const std::string& place) {
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number == std::floor(number) && number <= std::numeric_limits<std::int32_t>::max())) {
      fail(place, value, "a whole number from 0 to 2147483647");
      return false;
    }
    value = static_cast<std::int64_t>(number);
    return true;
  }

  void checkIndex(Json& value, std::string_view target, const std::string& place) {
    if (!checkCount(value, place) || target.empty()) return;
    const std::size_t size = sizeOf(target);
    if (value.get<std::size_t>() < size) return;
    const std::string name(target.substr(target.rfind('/') + 1));
    fail(place, value,
         size == 0 ? fmt::format("no index, because there are no {}", name)
                   : fmt::format("an index of {}, 0 to {}", name, size - 1));
  }

  std::size_t sizeOf(std::string_view target) {
    const auto [known, isNew] = m_sizes.try_emplace(target, 0);
    if (!isNew) return known->second;
    const Json* holder = &m_document;
    for (std::size_t begin = 0, end = 0; end != std::string_view::npos; begin = end + 1) {
      end = target.find('/', begin);
      if (!holder->is_object()) return 0;
      const auto found = holder->find(target.substr(begin, end - begin));
      if (found == holder->end()) return 0;
      holder = &*found;
    }
    return known->second = holder->is_array() ? holder->size() : 0;
  }

  const Json& m_document;
  Problems& m_problems;
  std::map<std::string_view, std::size_t> m_sizes;
};

} // namespace

void checkGltfSchema(nlohmann::json& document, Problems& problems) {
  if (!document.is_object()) return problems.add("JSON", "the root is not an object");
  // A document of another version breaks every rule below: which one it is says it all.
  const auto checkVersion = [&](const char* key, std::string_view expected, std::string_view prefix) {
    const auto asset = document.find("asset");
    if (asset == document.end() || !asset->is_object()) return true;
    const auto found = asset->find(key);
    if (found == asset->end() || !(found->is_string() || found->is_number())) return true;
    const std::string version = found->is_string() ? found->get<std::string>() : found->dump();
    if ((found->is_string() ? version : version + ".").starts_with(prefix)) return true;
    problems.add(fmt::format("/asset/{}", key),
                 fmt::format("is '{}', expected {}", cleanName(version).substr(0, 20), expected));
    return false;
  };
  if (!checkVersion("version", "glTF 2", "2.") || !checkVersion("minVersion", "2.0", "2.0")) return;
  Checker(document, problems).checkObject(document, gltfRules(), {});
}

} // namespace parity::scenes
