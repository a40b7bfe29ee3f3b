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

// The end of a message about an unknown name: "did you mean 'metric'?" where at most half of the longer name differs
// from the nearest known one, else "known: fail, metric, warn". prefix: put before each name that is said ("builtin:").
std::string describeNearest(std::string_view name, std::span<const std::string_view> known,
                            std::string_view prefix = {});

} // namespace parity::base
