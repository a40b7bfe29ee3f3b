// The TypeScript types of report.json and run.json: an interface for each record that has a name.
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/record/generated.h"
#include "report/record/report_records.h"
#include "report/term_words.h"

namespace parity::report {
namespace {

std::string typeName(std::string_view name) {
  std::string out(name);
  out[0] = static_cast<char>(out[0] - 'a' + 'A');
  return out;
}

std::string termWords() {
  std::string out;
  for (const auto& [term, words] : kTermWords) out += fmt::format("  {}: \"{}\",\n", term, words);
  return out;
}

std::string unionOf(const std::vector<std::string>& names) {
  return fmt::format("\"{}\"", fmt::join(names, "\" | \""));
}

class TypeWriter {
public:
  std::string write() {
    typeOf<Report>(Rule());
    typeOf<RunInfo>(Rule());
    return fmt::format(
        "// report.json and run.json. Made of report/record/*_records.h by "
        "build/describe_report: not to be edited.\n\n/** The form of report.json that is "
        "described here. */\nexport const kSchema = {};\n\n/** The terms of a path's light in words "
        "(report/term_words.h). */\nexport const kTermWords: Readonly<Record<string, string>> = {{\n{}}};\n\n{}",
        kReportSchema, termWords(), fmt::join(m_types, "\n"));
  }

private:
  template <typename T> std::string typeOf(const Rule& rule) {
    if constexpr (kIsOptional<T>) {
      return typeOf<typename T::value_type>(rule);
    } else if constexpr (std::is_same_v<T, bool>) {
      return "boolean";
    } else if constexpr (std::is_floating_point_v<T>) {
      return rule.finite ? "number" : "number | null";
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, Schema>) {
      return "number";
    } else if constexpr (std::is_same_v<T, std::string>) {
      return rule.oneOf.empty() ? "string" : unionOf(splitNames(rule.oneOf));
    } else if constexpr (kIsMap<T>) {
      return fmt::format("Record<string, {}>", typeOf<typename T::mapped_type>(Rule()));
    } else if constexpr (kIsList<T>) {
      using Element = typename T::value_type;
      if constexpr (IsByName<Element>)
        return "Record<string, number | null>";
      else
        return typeOf<Element>(Rule{.finite = rule.finite}) + "[]";
    } else {
      return named<T>(rule);
    }
  }

  template <Named T> std::string named(const Rule& rule) {
    std::vector<std::string> names;
    for (const T value : Names<T>::values) names.push_back(Names<T>::nameOf(value));
    if (!rule.oneOf.empty()) return unionOf(splitNames(rule.oneOf));
    if (Names<T>::name.empty()) return unionOf(names);
    std::string name = typeName(Names<T>::name);
    define(name, Names<T>::words, [&] { return fmt::format("type {} = {};\n", name, unionOf(names)); });
    return name;
  }
  template <Described T> std::string named(const Rule&) {
    std::string name = typeName(kRecord<T>.name);
    define(name, kRecord<T>.words,
           [&] { return fmt::format("interface {} {{\n{}}}\n", name, members("  ", kRecord<T>.rows, T())); });
    return name;
  }
  template <typename Body> void define(const std::string& name, std::string_view words, const Body& body) {
    if (!m_names.insert(name).second) return;
    const std::size_t place = m_types.size();
    m_types.emplace_back(); // before those that it needs itself
    std::string text = (words.empty() ? "" : fmt::format("/** {} */\n", words)) + "export " + body();
    m_types[place] = std::move(text);
  }

  // owner: names the type that the rows are of.
  template <typename Owner, typename... Rows>
  std::string members(const std::string& indent, const std::tuple<Rows...>& rows, const Owner& owner) {
    std::string out;
    forEachRow(rows, [&](const auto& row) { out += memberOf(row, indent, owner); });
    return out;
  }
  template <typename Member, typename Show, typename Owner>
  std::string memberOf(const Row<Member, Show>& row, const std::string& indent, const Owner&) {
    if constexpr (!kIsShown<Show>) {
      return "";
    } else {
      using Value = ShownType<Owner, Show>;
      const IfEmpty rule = ifEmpty<Value>(row.rule);
      std::string type = typeOf<Value>(row.rule);
      if (rule == IfEmpty::null && !type.ends_with("| null")) type += " | null";
      return fmt::format("{}{}{}: {};{}\n", indent, row.key, rule == IfEmpty::absent ? "?" : "", type,
                         row.words.empty() ? "" : fmt::format(" // {}", row.words));
    }
  }
  template <typename IsNull, typename... Rows, typename Owner>
  std::string memberOf(const Group<IsNull, Rows...>& group, const std::string& indent, const Owner& owner) {
    return fmt::format("{0}/** {1} */\n{0}{2}: {{\n{3}{0}}}{4};\n", indent, group.words, group.key,
                       members(indent + "  ", group.rows, owner), std::is_null_pointer_v<IsNull> ? "" : " | null");
  }

  std::set<std::string> m_names;
  std::vector<std::string> m_types;
};

} // namespace

std::string reportTypes() { return TypeWriter().write(); }

} // namespace parity::report
