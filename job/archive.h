// Plain structs as bytes and back, field by field, for the cache. A struct takes part by an overload of fields() that
// names every member in a structured binding: one that is added later does not compile until it is decided upon.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <glm/glm.hpp>

namespace parity::job {

// For overloads of fields() that take the const struct and the mutable one alike.
template <typename T, typename U>
concept Is = std::same_as<std::remove_const_t<T>, U>;

template <typename T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::same_as<T, glm::vec3>;

// The machine's byte order: the bytes are of use to the binary that wrote them alone.
class Writer {
public:
  template <Scalar T> void operator()(const T& value) { append(std::as_bytes(std::span{&value, 1})); }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    append(std::as_bytes(std::span{text}));
  }
  void operator()(const std::filesystem::path& path) { (*this)(path.string()); }
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
  template <typename T>
  requires requires(const T& value) { fields(value); }
  void operator()(const T& value) {
    std::apply([this](const auto&... each) { ((*this)(each), ...); }, fields(value));
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
    list.resize(count);
    for (T& each : list) (*this)(each);
  }
  template <typename T> void operator()(std::optional<T>& value) {
    bool present = false;
    (*this)(present);
    if (present) (*this)(value.emplace());
  }
  template <typename T>
  requires requires(T& value) { fields(value); }
  void operator()(T& value) {
    std::apply([this](auto&... each) { ((*this)(each), ...); }, fields(value));
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

} // namespace parity::job
