// A vector whose new elements are not set: for large arrays that are written at once, where clearing them first would
// take as long again.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace parity::base {

// Elements that are made without a value are left as they are in memory.
template <typename T> struct RawAllocator : std::allocator<T> {
  template <typename U> struct rebind { using other = RawAllocator<U>; };
  template <typename U> void construct(U* at) { ::new (static_cast<void*>(at)) U; }
  template <typename U, typename... Values> void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }
};

template <typename T> using RawVector = std::vector<T, RawAllocator<T>>;

} // namespace parity::base
