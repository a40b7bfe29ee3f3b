// Content hashes for caches and for telling whether two inputs are the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace parity::base {

inline constexpr std::size_t kHashDigits = 32; // of Hasher::hex

// Collects bytes into a 128-bit XXH3 hash. Not cryptographic.
class Hasher {
public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  Hasher& add(std::span<const std::byte> bytes);
  Hasher& add(std::string_view text); // length first, so that ("a","bc") differs from ("ab","c")
  // The bytes of a value; a struct must have no padding, whose content is undefined.
  template <typename T>
  requires std::is_trivially_copyable_v<T> Hasher& addValue(const T& value) {
    return add(std::as_bytes(std::span{&value, 1}));
  }
  std::string hex() const; // kHashDigits lower-case hexadecimal digits

private:
  void* m_state;
};

// Of a file's bytes. Throws what readFile throws.
std::string hashOfFile(const std::filesystem::path& file);

} // namespace parity::base
