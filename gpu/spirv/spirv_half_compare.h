// Comparisons of halves in a form that Mesa's software drivers run in less time.
#pragma once

#include <cstdint>
#include <vector>

namespace parity::gpu {

// The module with these instructions computed on doubled numbers of 32 bits:
//   - comparisons, FMin and FMax of scalar halves
//   - comparisons of 32-bit numbers with a constant that a half can hold
// LLVM 15 compares halves one by one: some 100 instructions for eight. It also turns a comparison of widened halves
// into one of halves, but not where they were doubled. Doubling is exact, so each comparison has the same result, also
// for NaN, infinities and denormals. FMin and FMax return the operand that is not NaN, as in Mesa 22.3. A module
// without halves does not change. The words must be valid SPIR-V. Deterministic. Throws Error (failed) for words that
// are no SPIR-V, as SpirvModule does.
std::vector<std::uint32_t> compareHalvesWidened(std::vector<std::uint32_t> words);

} // namespace parity::gpu
