// How many members a plain struct has, at compile time: what lists them all can then say that it does.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace parity::base {

template <typename T> struct AnyMember {
  template <typename Member>
  requires(!std::same_as<T, std::remove_cvref_t<Member>>)
  operator Member() const; // never defined: for `requires` alone
};

template <typename T, std::size_t... index> constexpr bool takesMembers(std::index_sequence<index...>) {
  return requires { T{(static_cast<void>(index), AnyMember<T>())...}; };
}

// Of an aggregate without base classes and without plain arrays.
template <typename T, std::size_t most = 64> constexpr std::size_t memberCount() {
  static_assert(std::is_aggregate_v<T>);
  if constexpr (takesMembers<T>(std::make_index_sequence<most>()))
    return most;
  else
    return memberCount<T, most - 1>();
}

} // namespace parity::base
