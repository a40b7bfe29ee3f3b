// What the allocator of programs (base/allocator.cpp) decides when a program starts.
#pragma once

#include <span>

namespace parity::base {

// Whether the program should ask the system for pages of 2 MiB instead of 4 KiB. touches: what the first touch of
// each of some new pages of 4 KiB took, in seconds; at least one; they are reordered. Large pages are faster where most
// of them took more than 4 microseconds (docs/benchmarks.md). On a usual machine they take .3 to 1.5.
bool areLargePagesFaster(std::span<double> touches);

} // namespace parity::base
