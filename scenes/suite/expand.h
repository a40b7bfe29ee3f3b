// Suite tables as scenes: each file in each environment with each preset, and what overrides say of them.
#pragma once

#include <vector>

#include "scenes/suite/suite_tables.h"

namespace parity::scenes {

inline constexpr std::size_t kMostScenes = 200'000; // of a suite

// In the order of the tables; of a table file by file, the last list of values fastest. Names are made from the table's
// `name`: {stem}, {folder} and {file} are of the file, {environment} and {preset} of the value that a list, the table
// or [defaults] gives. Without a `name`: the stem, and the value of each list of several. Throws Error (exit 4).
std::vector<SuiteEntry> expandScenes(const SuiteTables& tables);

// Applies the overrides in their order; a later one goes before an earlier one. Throws Error (exit 4) for a glob that
// matches nothing.
void applyOverrides(std::vector<OverrideTable>& overrides, std::vector<SuiteEntry>& entries);

// Throws Error (exit 4) where two scenes have one name.
void requireDifferentNames(const std::vector<SuiteEntry>& entries);

} // namespace parity::scenes
