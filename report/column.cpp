#include "report/column.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "report/base64.h"

namespace parity::report {
namespace {

template <typename T> std::string pack(const std::vector<std::uint32_t>& values) {
  std::vector<std::byte> bytes;
  bytes.reserve(values.size() * sizeof(T));
  for (const std::uint32_t value : values)
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i) & 255));
  return toBase64(bytes);
}

void writePacked(base::JsonWriter& json, const char* kind, const std::string& data) {
  json.beginObject();
  json.key(kind).text(data);
  json.endObject();
}

template <typename T> bool isSame(const std::vector<T>& values) {
  return std::ranges::all_of(values, [&](const T& value) { return value == values.front(); });
}

} // namespace

void writeColumn(base::JsonWriter& json, const std::vector<std::uint32_t>& values) {
  if (isSame(values)) return json.integer(values.empty() ? 0 : values.front());
  const std::uint32_t most = *std::ranges::max_element(values);
  if (most <= std::numeric_limits<std::uint8_t>::max()) return writePacked(json, "u8", pack<std::uint8_t>(values));
  if (most <= std::numeric_limits<std::uint16_t>::max()) return writePacked(json, "u16", pack<std::uint16_t>(values));
  writePacked(json, "u32", pack<std::uint32_t>(values));
}

void writeColumn(base::JsonWriter& json, const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  bits.reserve(values.size());
  for (const float value : values)
    bits.push_back(
        std::bit_cast<std::uint32_t>(std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN()));
  if (!isSame(bits)) return writePacked(json, "f32", pack<std::uint32_t>(bits));
  json.number(bits.empty() ? 0 : std::bit_cast<float>(bits.front())); // NaN is null
}

void ColumnTable::write(base::JsonWriter& json) const {
  json.key("count").integer(count());
  json.key("columns").beginObject();
  for (const auto& [name, values] : m_wholes) writeColumn(json.key(name), values);
  for (const auto& [name, values] : m_reals) writeColumn(json.key(name), values);
  json.endObject();
}

std::uint32_t TextTable::place(std::string_view text) {
  const auto [found, isNew] = m_places.emplace(text, static_cast<std::uint32_t>(m_texts.size()));
  if (isNew) m_texts.push_back(&found->first);
  return found->second;
}

void TextTable::write(base::JsonWriter& json) const {
  json.beginArray();
  for (const std::string* text : m_texts) json.text(*text);
  json.endArray();
}

std::uint32_t ListTable::place(const std::vector<std::uint32_t>& list) {
  const auto [found, isNew] = m_places.emplace(list, static_cast<std::uint32_t>(m_lists.size()));
  if (isNew) m_lists.push_back(&found->first);
  return found->second;
}

void ListTable::write(base::JsonWriter& json) const {
  json.beginArray();
  for (const std::vector<std::uint32_t>* list : m_lists) {
    json.beginArray();
    for (const std::uint32_t place : *list) json.integer(place);
    json.endArray();
  }
  json.endArray();
}

} // namespace parity::report
