// The bar on a terminal: what is done, how much of it, since when, and how long it may still take.
#pragma once

#include <cstddef>
#include <string>

#include "job/settings.h"

namespace parity::cli {

// A bar on stderr where that is a terminal that can be drawn over and nobody asked for quiet; else nothing. Erases
// itself at 1.
job::Progress makeProgress(bool quiet);

// The line: bar, percentage, elapsed time, the time that is left at the pace so far (after the first seconds), what is
// being done. At most `columns` wide.
std::string describeProgress(const std::string& what, double done, double elapsedS, std::size_t columns);

// For the scene `index` of `count`, which run one after the other: tells how many are done, and what is done of all.
// `whole` must outlive it.
job::Progress progressOfScene(const job::Progress& whole, std::size_t index, std::size_t count);

} // namespace parity::cli
