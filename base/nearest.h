// What the user probably meant: the known name nearest to an unknown one.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace parity::base {

// Least number of bytes inserted, removed, replaced or swapped with their neighbour that turns `a` into `b`; letters of
// ASCII count the same in either case (Damerau-Levenshtein, optimal string alignment).
std::size_t editDistance(std::string_view a, std::string_view b);

// The first of `known` with the least distance to `name`; empty where `known` is.
std::string nearestName(std::string_view name, std::span<const std::string_view> known);

} // namespace parity::base
