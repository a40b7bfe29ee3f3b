// report.json (report/report.schema.json) and run.json: the rows of their records as JSON.
#include "base/text/json_writer.h"
#include "report/record/report_records.h"
#include "report/report.h"

namespace parity::report {
namespace {

class RecordWriter {
public:
  explicit RecordWriter(base::JsonLayout layout) : m_json(layout) {}

  template <typename T> void write(const T& value) {
    if constexpr (std::is_same_v<T, bool>)
      m_json.boolean(value);
    else if constexpr (std::is_same_v<T, Schema>)
      m_json.integer(Schema::value);
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
};

template <typename T> std::string written(const T& record, base::JsonLayout layout) {
  RecordWriter writer(layout);
  writer.write(record);
  return writer.finish();
}

} // namespace

std::string toJson(const Report& report, base::JsonLayout layout) { return written(report, layout); }
std::string toJson(const RunInfo& run, base::JsonLayout layout) { return written(run, layout); }

} // namespace parity::report
