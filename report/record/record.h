// What a record of the report is made of, said once: a row for each of its keys. The archive of the cache, JSON, its
// reader, the JSON Schema and the page's TypeScript types are made from the rows.
//
//   template <> inline constexpr auto kRecord<TermEffect> = record<TermEffect>(
//       "termEffect", "", field("term", &TermEffect::term),
//       field("flip", &TermEffect::flip, "Mean, once the test has the reference's term", {.least = 0}));
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/member_count.h"

namespace parity::report {

// What stands in JSON for a value that is empty (isEmpty). An optional that says nothing else is absent.
enum class IfEmpty { written, null, absent };

struct Rule {
  bool kept = true;      // in the archive; not what judging sets, nor what the archive's key holds
  bool read = false;     // from the JSON of an earlier report
  bool readDeep = false; // the same, but only where more is asked for (report/reader.h)
  bool mayLack = false;  // of what is read: where it is absent, it is as by default
  IfEmpty ifEmpty = IfEmpty::written;
  bool finite = false;         // of a real: it is never null
  bool filled = false;         // of a text: it is never empty
  std::string_view oneOf = {}; // of a text: "point|spot"; empty: any
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};

// One key, in the order of the JSON. Member: a pointer to the member, or nullptr_t: it is computed. Show: what JSON
// holds, from the record; nullptr_t: no JSON does.
template <typename Member, typename Show> struct Row {
  std::string_view key;
  Member member;
  Show show;
  std::string_view words; // what it is, where the key does not say it
  Rule rule;
};

// Several rows of a record as one object of its JSON. IsNull: from the record, or nullptr_t: it never is.
template <typename IsNull, typename... Rows> struct Group {
  std::string_view key, words;
  IsNull isNull;
  std::tuple<Rows...> rows;
};

template <typename Owner, typename... Rows> struct Record {
  std::string_view name, words; // of the type in the schema: "material"
  std::tuple<Rows...> rows;
};

// A member as it is.
template <typename Owner, typename Value>
constexpr auto field(std::string_view key, Value Owner::*member, std::string_view words = {}, Rule rule = {}) {
  return Row{key, member, member, words, rule};
}
// A member of which JSON shows something else; what is read is what is shown.
template <typename Owner, typename Value, typename Show> constexpr auto
shown(std::string_view key, Value Owner::*member, Show show, std::string_view words = {}, Rule rule = {}) {
  return Row{key, member, show, words, rule};
}
// What follows from the members: it is written, never read, and not in the archive.
template <typename Show>
constexpr auto computed(std::string_view key, Show show, std::string_view words = {}, Rule rule = {}) {
  return Row{key, nullptr, show, words, rule};
}
// A member that is in no JSON.
template <typename Owner, typename Value> constexpr auto hidden(Value Owner::*member, Rule rule = {}) {
  return Row{"", member, nullptr, "", rule};
}
template <typename... Rows> constexpr auto group(std::string_view key, std::string_view words, Rows... rows) {
  return Group{key, words, nullptr, std::tuple{rows...}};
}
template <typename IsNull, typename... Rows>
constexpr auto groupOrNull(std::string_view key, std::string_view words, IsNull isNull, Rows... rows) {
  return Group{key, words, isNull, std::tuple{rows...}};
}

template <typename Row> inline constexpr std::size_t kMembersIn = 0;
template <typename Member, typename Show> inline constexpr std::size_t kMembersIn<Row<Member, Show>> =
    std::is_member_object_pointer_v<Member> ? 1 : 0;
template <typename IsNull, typename... Rows>
inline constexpr std::size_t kMembersIn<Group<IsNull, Rows...>> = (kMembersIn<Rows> + ... + 0);

template <typename Owner, typename... Rows>
constexpr auto record(std::string_view name, std::string_view words, Rows... rows) {
  if constexpr (std::is_aggregate_v<Owner>)
    static_assert((kMembersIn<Rows> + ... + 0) == base::memberCount<Owner>(), "a member has no row, or two");
  return Record<Owner, Rows...>{name, words, std::tuple{rows...}};
}

// The description of a record. One that is in no schema has no name.
template <typename T> inline constexpr std::nullptr_t kRecord = nullptr;
template <typename T>
concept Described = !std::is_same_v<decltype(kRecord<T>), const std::nullptr_t>;

// An enumeration by its names: `values`, `nameOf`; `refusal`: "'{}' is no verdict"; `name`, `words` as a record has
// them (no name: it is written out where it stands).
template <typename T> struct Names {};
template <typename T>
concept Named = requires {
  Names<T>::values;
};

// An element whose list is an object in JSON, by its name: `keyOf`, `valueOf`, and, if it is read, `make` from name and
// value (empty: null).
template <typename T> struct ByName {};
template <typename T>
concept IsByName = requires(const T& value) {
  ByName<T>::keyOf(value);
};

template <typename T> inline constexpr bool kIsOptional = false;
template <typename T> inline constexpr bool kIsOptional<std::optional<T>> = true;
template <typename T> inline constexpr bool kIsList = false;
template <typename T> inline constexpr bool kIsList<std::vector<T>> = true;
template <typename T> inline constexpr bool kIsMap = false;
template <typename T> inline constexpr bool kIsMap<std::map<std::string, T>> = true;

// What a row means by "empty"; specialised for records that are empty without pixels.
template <typename T> struct Emptiness {
  static bool isEmpty(const T& value) {
    if constexpr (kIsOptional<T>) return !value.has_value();
    if constexpr (std::is_same_v<T, std::string> || kIsList<T>) return value.empty();
    if constexpr (std::is_same_v<T, bool>) return !value;
    return false;
  }
};

template <typename T> constexpr IfEmpty ifEmpty(const Rule& rule) {
  return kIsOptional<T> && rule.ifEmpty == IfEmpty::written ? IfEmpty::absent : rule.ifEmpty;
}

// "point|spot" as a list.
inline std::vector<std::string> splitNames(std::string_view names) {
  std::vector<std::string> list;
  for (;;) {
    const std::size_t end = names.find('|');
    list.emplace_back(names.substr(0, end));
    if (end == std::string_view::npos) return list;
    names.remove_prefix(end + 1);
  }
}

// The type that JSON holds of a row.
template <typename Owner, typename Show> using ShownType =
    std::remove_cvref_t<std::invoke_result_t<Show, const Owner&>>;
template <typename Show> inline constexpr bool kIsShown = !std::is_null_pointer_v<Show>;

// Calls visit(row) or visit(group) for each, in order.
template <typename... Rows, typename Visit> void forEachRow(const std::tuple<Rows...>& rows, Visit&& visit) {
  std::apply([&](const Rows&... each) { (visit(each), ...); }, rows);
}
template <typename Row> inline constexpr bool kIsGroup = false;
template <typename IsNull, typename... Rows> inline constexpr bool kIsGroup<Group<IsNull, Rows...>> = true;

} // namespace parity::report
