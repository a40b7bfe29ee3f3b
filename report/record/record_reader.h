// JSON back into described records: every value that is read is there and of its type, or the place of it is named.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "report/record/node.h"
#include "report/record/record.h"

namespace parity::report {

template <Described T> void readRecord(const Node& node, T& record);

// What a row that is read may hold.
inline void readValue(const Node& node, std::string& value) { value = node.text(); }
inline void readValue(const Node& node, std::uint64_t& value) { value = node.count(); }
inline void readValue(const Node& node, double& value) { value = node.isNull() ? NAN : node.number(); }
inline void readValue(const Node& node, bool& value) { value = node.flag(); }
inline void readValue(const Node& node, std::vector<std::string>& list) {
  for (const Node& each : node.items()) list.push_back(each.text());
}
template <Named T> void readValue(const Node& node, T& value) {
  const std::string name = node.text();
  for (const T each : Names<T>::values)
    if (name == Names<T>::nameOf(each)) return static_cast<void>(value = each);
  node.refuse(fmt::format(fmt::runtime(Names<T>::refusal), name));
}
template <Described T> void readValue(const Node& node, T& value) { readRecord(node, value); }
template <Described T> void readValue(const Node& node, std::optional<T>& value) { readRecord(node, value.emplace()); }
template <typename T>
requires(Described<T> && !IsByName<T>) void readValue(const Node& node, std::vector<T>& list) {
  for (const Node& each : node.items()) readRecord(each, list.emplace_back());
}
template <IsByName T>
requires requires { &ByName<T>::make; }
void readValue(const Node& node, std::vector<T>& list) {
  for (const auto& [name, value] : node.members())
    list.push_back(ByName<T>::make(name, value.isNull() ? std::nullopt : std::optional(value.number())));
}

template <typename Member, typename Show> bool isRead(const Row<Member, Show>& row, ReadDepth depth) {
  return row.rule.read || (row.rule.readDeep && depth == ReadDepth::checks);
}
template <typename IsNull, typename... Rows> bool isRead(const Group<IsNull, Rows...>& group, ReadDepth depth) {
  return std::apply([&](const Rows&... rows) { return (isRead(rows, depth) || ...); }, group.rows);
}

template <typename Owner, typename Row>
concept Readable = requires(const Node& node, Owner& owner, const Row& row) {
  readValue(node, owner.*row.member);
};

// Whether a row that is read is of a type that can be.
template <typename Owner, typename Member, typename Show> constexpr bool isReadable(const Row<Member, Show>& row) {
  return (!row.rule.read && !row.rule.readDeep) || Readable<Owner, Row<Member, Show>>;
}
template <typename Owner, typename IsNull, typename... Rows>
constexpr bool isReadable(const Group<IsNull, Rows...>& group) {
  return std::apply([](const Rows&... rows) { return (isReadable<Owner>(rows) && ...); }, group.rows);
}

template <typename Owner, typename Row> using MemberType =
    std::remove_cvref_t<decltype(std::declval<Owner&>().*std::declval<Row>().member)>;

template <typename Owner, typename... Rows>
void readRows(const Node& node, Owner& owner, const std::tuple<Rows...>& rows) {
  forEachRow(rows, [&]<typename Row>(const Row& row) {
    if (!isRead(row, node.depth())) return;
    const std::string key(row.key);
    if constexpr (kIsGroup<Row>) {
      const Node child = node.at(key);
      if (std::is_null_pointer_v<decltype(row.isNull)> || !child.isNull()) readRows(child, owner, row.rows);
    } else if constexpr (Readable<Owner, Row>) {
      const bool mayLack = row.rule.mayLack || ifEmpty<MemberType<Owner, Row>>(row.rule) == IfEmpty::absent;
      if (mayLack && !node.has(key)) return;
      const Node child = node.at(key);
      if (row.rule.ifEmpty != IfEmpty::null || !child.isNull()) readValue(child, owner.*row.member);
    }
  });
}
template <Described T> void readRecord(const Node& node, T& record) {
  static_assert(std::apply([](const auto&... rows) { return (isReadable<T>(rows) && ...); }, kRecord<T>.rows));
  readRows(node, record, kRecord<T>.rows);
}

} // namespace parity::report
