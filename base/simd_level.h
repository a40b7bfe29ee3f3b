// Which instruction set the loops take that Highway compiles for several of them.
#pragma once

#include <string>
#include <vector>

namespace parity::base {

// Names of the instruction sets that this processor can run, the best first ("AVX3", "AVX2", "SSE4", ...), and the
// choice of one for all later calls ("": the best again), for tests and benchmarks. Throws Error (usage) for another.
std::vector<std::string> simdLevels();
void useSimdLevel(const std::string& name);

} // namespace parity::base
