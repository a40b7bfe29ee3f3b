// Described records as bytes and back, for the cache: the members that are kept, in the order of their rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "report/record/record.h"

namespace parity::report {

template <typename T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// Calls visit with each member that is kept; `record` may be const.
template <typename Owner, typename Rows, typename Visit>
void forEachKept(Owner& record, const Rows& rows, const Visit& visit) {
  forEachRow(rows, [&]<typename Row>(const Row& row) {
    if constexpr (kIsGroup<Row>)
      forEachKept(record, row.rows, visit);
    else if constexpr (std::is_member_object_pointer_v<decltype(row.member)>)
      if (row.rule.kept) visit(record.*row.member);
  });
}

// The machine's byte order: the bytes are of use to the binary that wrote them alone.
class Writer {
public:
  template <Scalar T> void operator()(const T& value) { append(std::as_bytes(std::span{&value, 1})); }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    append(std::as_bytes(std::span{text}));
  }
  void operator()(const std::vector<std::byte>& bytes) {
    (*this)(static_cast<std::uint64_t>(bytes.size()));
    append(bytes);
  }
  template <typename T> void operator()(const std::vector<T>& list) {
    (*this)(static_cast<std::uint64_t>(list.size()));
    for (const T& each : list) (*this)(each);
  }
  template <typename T> void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }
  template <Described T> void operator()(const T& record) {
    forEachKept(record, kRecord<T>.rows, [this](const auto& member) { (*this)(member); });
  }
  const std::vector<std::byte>& bytes() const { return m_bytes; }

private:
  void append(std::span<const std::byte> bytes) { m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end()); }
  std::vector<std::byte> m_bytes;
};

// Throws std::out_of_range where the bytes end early, before memory is taken for them.
class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : m_rest(bytes) {}

  template <Scalar T> void operator()(T& value) { std::memcpy(&value, take(sizeof value).data(), sizeof value); }
  void operator()(bool& value) {
    std::uint8_t byte = 0;
    (*this)(byte);
    if (byte > 1) throw std::out_of_range("a flag");
    value = byte == 1;
  }
  void operator()(std::string& text) {
    const auto bytes = take(readSize());
    text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  void operator()(std::vector<std::byte>& out) {
    const auto bytes = take(readSize());
    out.assign(bytes.begin(), bytes.end());
  }
  template <typename T> void operator()(std::vector<T>& list) {
    const std::size_t count = readSize();
    if (count > m_rest.size()) throw std::out_of_range("a list"); // no element takes less than a byte
    list.clear();
    for (std::size_t i = 0; i < count; ++i) (*this)(list.emplace_back());
  }
  template <typename T> void operator()(std::optional<T>& value) {
    bool present = false;
    (*this)(present);
    if (present) (*this)(value.emplace());
  }
  template <Described T> void operator()(T& record) {
    forEachKept(record, kRecord<T>.rows, [this](auto& member) { (*this)(member); });
  }
  bool atEnd() const { return m_rest.empty(); }

private:
  std::size_t readSize() {
    std::uint64_t size = 0;
    (*this)(size);
    return static_cast<std::size_t>(size);
  }
  std::span<const std::byte> take(std::size_t count) {
    if (count > m_rest.size()) throw std::out_of_range("bytes");
    const auto taken = m_rest.first(count);
    m_rest = m_rest.subspan(count);
    return taken;
  }
  std::span<const std::byte> m_rest;
};

} // namespace parity::report
