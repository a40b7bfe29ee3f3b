// Described records as JSON: the rows that it shows, in their order.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/text/json_writer.h"
#include "report/record/record.h"

namespace parity::report {

// Of a member that a page loads scene by scene.
template <typename Member> inline constexpr bool kIsOfScenes = false;

// A number that is the same in every record: the version of a format.
template <typename T> inline constexpr bool kIsConstant = false;
template <int value> inline constexpr bool kIsConstant<std::integral_constant<int, value>> = true;

class RecordWriter {
public:
  // isHead: without what a page has scene by scene.
  explicit RecordWriter(base::JsonLayout layout, base::TextSink sink = {}, bool isHead = false)
      : m_json(layout, std::move(sink)), m_isHead(isHead) {}

  template <typename T> void write(const T& value) {
    if constexpr (std::is_same_v<T, bool>)
      m_json.boolean(value);
    else if constexpr (kIsConstant<T>)
      m_json.integer(T::value);
    else if constexpr (std::is_integral_v<T>)
      m_json.integer(value);
    else if constexpr (std::is_floating_point_v<T>)
      m_json.number(value);
    else if constexpr (std::is_same_v<T, std::string>)
      m_json.text(value);
    else if constexpr (Named<T>)
      m_json.text(Names<T>::nameOf(value));
    else
      writeWhole(value);
  }
  std::string finish() { return m_json.finish(); }

private:
  template <typename T> void writeWhole(const std::optional<T>& value) { write(*value); }
  template <typename T> void writeWhole(const std::vector<T>& list) {
    if constexpr (IsByName<T>) {
      m_json.beginObject();
      for (const T& each : list) m_json.key(ByName<T>::keyOf(each)).number(ByName<T>::valueOf(each));
      return m_json.endObject();
    }
    m_json.beginArray();
    for (const T& each : list) write(each);
    m_json.endArray();
  }
  template <typename T> void writeWhole(const std::map<std::string, T>& map) {
    m_json.beginObject();
    for (const auto& [name, value] : map) {
      m_json.key(name);
      write(value);
    }
    m_json.endObject();
  }
  template <Described T> void writeWhole(const T& record) { writeRows(record, kRecord<T>.rows); }

  template <typename Owner, typename... Rows> void writeRows(const Owner& owner, const std::tuple<Rows...>& rows) {
    m_json.beginObject();
    forEachRow(rows, [&](const auto& row) { writeRow(owner, row); });
    m_json.endObject();
  }
  template <typename Owner, typename Member, typename Show>
  void writeRow(const Owner& owner, const Row<Member, Show>& row) {
    if constexpr (kIsShown<Show>) {
      if constexpr (kIsOfScenes<Member>)
        if (m_isHead) return;
      const auto& value = std::invoke(row.show, owner);
      using Value = std::remove_cvref_t<decltype(value)>;
      const IfEmpty rule = ifEmpty<Value>(row.rule);
      const bool isEmpty = rule != IfEmpty::written && Emptiness<Value>::isEmpty(value);
      if (isEmpty && rule == IfEmpty::absent) return;
      m_json.key(row.key);
      if (isEmpty)
        m_json.null();
      else
        write(value);
    }
  }
  template <typename Owner, typename IsNull, typename... Rows>
  void writeRow(const Owner& owner, const Group<IsNull, Rows...>& group) {
    m_json.key(group.key);
    if constexpr (!std::is_null_pointer_v<IsNull>)
      if (group.isNull(owner)) return m_json.null();
    writeRows(owner, group.rows);
  }

  base::JsonWriter m_json;
  bool m_isHead;
};

} // namespace parity::report
