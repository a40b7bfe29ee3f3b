// The passes of a scene's run: what was done, how much of it, and what was left undone because nothing needed it.
#pragma once

#include <cstdint>
#include <string>

namespace parity::report {

struct PassResult {
  std::string name;        // "environment prefilter"
  std::string unit;        // what `count` counts: "maps"
  std::uint64_t count = 0; // counted where the work is done; what a cache gave counts as done
  std::string skipped;     // why there was none; empty where count > 0
};

} // namespace parity::report
