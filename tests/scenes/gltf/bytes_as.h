// Bytes as the numbers that they are.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

namespace parity::tests {

template <typename T> std::vector<T> as(const std::vector<std::byte>& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

} // namespace parity::tests
