// Sets of code points, as the ranges that they are made of.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace parity::base {

struct CodeRange {
  std::uint32_t first, last;
};

template <std::size_t N> bool contains(const std::array<CodeRange, N>& ranges, std::uint32_t code) {
  return std::ranges::any_of(ranges, [code](const CodeRange& r) { return r.first <= code && code <= r.last; });
}

} // namespace parity::base
