// A number of each of many rows as the page reads it: packed, so that a hundred thousand rows take little room and no
// parsing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/text/json_writer.h"

namespace parity::report {

// Writes a value where all rows have the same one, and of no rows 0; else {"u8": DATA}, {"u16": DATA} or {"u32": DATA},
// the smallest that holds them. DATA: base64 of the values, little-endian.
void writeColumn(base::JsonWriter& json, const std::vector<std::uint32_t>& values);
// The same as {"f32": DATA}; NaN and infinities are NaN there, and null where all rows have one.
void writeColumn(base::JsonWriter& json, const std::vector<float>& values);

// Columns by name, in the order in which they are first named. Each row gives each of them one value.
class ColumnTable {
public:
  std::vector<std::uint32_t>& whole(std::string_view name) { return named(m_wholes, name); }
  std::vector<float>& real(std::string_view name) { return named(m_reals, name); }
  std::size_t count() const { return m_wholes.empty() ? 0 : m_wholes.front().second.size(); } // of rows
  void write(base::JsonWriter& json) const; // "count" and "columns" of an object

private:
  // Names are literals.
  template <typename Values> using Named = std::vector<std::pair<std::string_view, Values>>;
  template <typename Values> static Values& named(Named<Values>& columns, std::string_view name) {
    for (auto& [each, values] : columns)
      if (each == name) return values;
    return columns.emplace_back(name, Values()).second;
  }

  Named<std::vector<std::uint32_t>> m_wholes;
  Named<std::vector<float>> m_reals;
};

// Texts of which columns hold the place, each once; "" is at 0. Places are given in the order in which texts come.
class TextTable {
public:
  TextTable() { place(""); }
  std::uint32_t place(std::string_view text);
  void write(base::JsonWriter& json) const; // a list

private:
  std::unordered_map<std::string, std::uint32_t> m_places;
  std::vector<const std::string*> m_texts; // keys of m_places, which stay where they are
};

// The same of lists of texts, by their places in a table of texts; the empty list is at 0.
class ListTable {
public:
  ListTable() { place({}); }
  std::uint32_t place(const std::vector<std::uint32_t>& list);
  void write(base::JsonWriter& json) const; // a list of lists

private:
  std::map<std::vector<std::uint32_t>, std::uint32_t> m_places;
  std::vector<const std::vector<std::uint32_t>*> m_lists;
};

} // namespace parity::report
