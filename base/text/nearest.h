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

// "did you mean 'metric'?" where at most half of the longer name differs from the nearest known one; else empty.
// prefix: put before each name that is said ("builtin:").
std::string askNearest(std::string_view name, std::span<const std::string_view> known, std::string_view prefix = {});

// The end of a message about an unknown name: askNearest(), or where it is empty "known: fail, metric, warn" (the first
// 24 names).
std::string describeNearest(std::string_view name, std::span<const std::string_view> known,
                            std::string_view prefix = {});

// The same of a glob (base/text/glob.h) that matches none of the names: '*' is any run of characters, '?' and a set any
// one. At most half of the glob's own letters differ from the name that is asked for.
std::string describeNearestToGlob(std::string_view glob, std::span<const std::string_view> known);

} // namespace parity::base
