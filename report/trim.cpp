#include "report/trim.h"

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "report/record/report_records.h"

namespace parity::report {
namespace {

void trimValue(std::string& text) { text.shrink_to_fit(); }
template <typename T>
requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void trimValue(T&) {}
template <typename T> void trimValue(std::optional<T>& value);
template <Described T> void trimValue(T& record);
template <typename T> void trimValue(std::vector<T>& list) {
  list.shrink_to_fit();
  for (T& each : list) trimValue(each);
}
template <typename T> void trimValue(std::optional<T>& value) {
  if (value) trimValue(*value);
}

template <typename Owner, typename... Rows> void trimMembers(Owner& owner, const std::tuple<Rows...>& rows) {
  forEachRow(rows, [&]<typename Row>(const Row& row) {
    if constexpr (kIsGroup<Row>)
      trimMembers(owner, row.rows);
    else if constexpr (std::is_member_object_pointer_v<decltype(row.member)>)
      trimValue(owner.*row.member);
  });
}
template <Described T> void trimValue(T& record) { trimMembers(record, kRecord<T>.rows); }

} // namespace

void trim(SceneResult& scene) { trimValue(scene); }

} // namespace parity::report
