// Of files made by hand, byte by byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace parity::tests {

using Bytes = std::vector<std::byte>;

inline void addText(Bytes& bytes, const std::string& text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

// The low `count` bytes, the lowest first.
inline void add(Bytes& bytes, std::uint64_t value, int count = 4) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i) & 0xff));
}

} // namespace parity::tests
