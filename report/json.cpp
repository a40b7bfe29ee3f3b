// report.json (report/report.schema.json) and run.json: the rows of their records as JSON.
#include <utility>

#include "base/text/json_writer.h"
#include "report/record/report_records.h"
#include "report/report.h"

namespace parity::report {
namespace {

template <typename Member> inline constexpr bool kIsOfScenes =
    std::is_same_v<Member, std::vector<SceneResult> Report::*> ||
    std::is_same_v<Member, std::vector<AgainCommand> RunInfo::*>;

class RecordWriter {
public:
  // isHead: without what a page has scene by scene.
  explicit RecordWriter(base::JsonLayout layout, base::TextSink sink = {}, bool isHead = false)
      : m_json(layout, std::move(sink)), m_isHead(isHead) {}

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

template <typename T> std::string written(const T& record, base::JsonLayout layout, bool isHead = false) {
  RecordWriter writer(layout, {}, isHead);
  writer.write(record);
  return writer.finish();
}

} // namespace

void writeJson(const Report& report, const base::TextSink& sink, base::JsonLayout layout) {
  RecordWriter writer(layout, sink);
  writer.write(report);
  writer.finish();
}

std::string toJson(const Report& report, base::JsonLayout layout) { return written(report, layout); }
std::string toJson(const RunInfo& run, base::JsonLayout layout) { return written(run, layout); }
std::string headJson(const Report& report) { return written(report, base::JsonLayout::compact, true); }
std::string headJson(const RunInfo& run) { return written(run, base::JsonLayout::compact, true); }
std::string toJson(const AgainCommand& command) { return written(command, base::JsonLayout::compact); }
std::string toJson(const SceneResult& scene) { return written(scene, base::JsonLayout::compact); }

} // namespace parity::report
